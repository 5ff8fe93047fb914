//! Decisions taken from words, one after the other: any bits, and numbers as flights have them.

/// What is left of the words.
#[derive(Clone, Copy, Debug)]
pub struct Words<'a>(pub &'a [u32]);

impl Words<'_> {
    /// The next word; `None` when they have run out.
    pub fn word(&mut self) -> Option<u32> {
        let (&first, rest) = self.0.split_first()?;
        self.0 = rest;
        Some(first)
    }

    /// Any bit pattern in five of eight, else a number within ±8 or one at the edge of what is accepted.
    pub fn number(&mut self) -> Option<f32> {
        const EDGES: [f32; 8] = [1e5, -1e5, 1e6, -1e6, 1e-40, -1e-40, 0.0, -0.0];
        let word = self.word()?;
        Some(match word & 7 {
            0..5 => f32::from_bits(self.word()?),
            5 | 6 => (word >> 8) as f32 / 1_048_576.0 - 8.0,
            _ => EDGES[(word >> 3) as usize & 7],
        })
    }

    /// N of them.
    pub fn numbers<const N: usize>(&mut self) -> Option<[f32; N]> {
        let mut all = [0.0; N];
        for each in &mut all {
            *each = self.number()?;
        }
        Some(all)
    }
}
