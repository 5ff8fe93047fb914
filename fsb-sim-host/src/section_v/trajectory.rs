//! The spiral reference of Section V, with its derivatives.
//!
//! x_d = a sin φ, y_d = a cos φ;  a = 9 - 8 e^(-0.2 t), φ = (2 - e^(-t)) t.

/// One axis of the reference at one time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// [m]
    pub position: f64,
    /// [m/s]
    pub velocity: f64,
    /// [m/s²]
    pub acceleration: f64,
}

/// x_d and y_d at `t` [s].
pub fn reference(t: f64) -> [Point; 2] {
    let (fade, slow) = ((-t).exp(), (-0.2 * t).exp());
    let [a, da, dda] = [9.0 - 8.0 * slow, 1.6 * slow, -0.32 * slow];
    let [phase, rate, change] = [(2.0 - fade) * t, 2.0 - fade + t * fade, (2.0 - t) * fade];
    let (sin, cos) = phase.sin_cos();
    // (a u)'' = a'' u + 2 a' u' + a u'', with u = sin φ or cos φ
    let point = |u: f64, du: f64| Point {
        position: a * u,
        velocity: da * u + a * rate * du,
        acceleration: dda * u + 2.0 * da * rate * du + a * (change * du - rate * rate * u),
    };
    [point(sin, cos), point(cos, -sin)]
}

#[cfg(test)]
mod tests {
    use super::reference;

    /// The printed formulas, and the derivatives by central differences.
    #[test]
    fn derivatives_belong_to_the_printed_formulas() {
        let printed = |t: f64| {
            let a = 9.0 - 8.0 * (-0.2 * t).exp();
            let phase = (2.0 - (-t).exp()) * t;
            [a * phase.sin(), a * phase.cos()]
        };
        let step = 1e-4;
        for t in [0.0, 0.3, 1.0, 4.7, 10.0] {
            let [before, here, after] = [printed(t - step), printed(t), printed(t + step)];
            for axis in 0..2 {
                let point = reference(t)[axis];
                let velocity = (after[axis] - before[axis]) / (2.0 * step);
                let acceleration = (after[axis] - 2.0 * here[axis] + before[axis]) / (step * step);
                assert!((point.position - here[axis]).abs() < 1e-14, "t = {t}");
                assert!((point.velocity - velocity).abs() < 1e-5, "t = {t}");
                assert!((point.acceleration - acceleration).abs() < 1e-4, "t = {t}");
            }
        }
    }

    /// Near the real values of Table 1 at 10 s: the loop tracks, so the reference is within centimetres of them.
    #[test]
    fn passes_where_the_paper_says() {
        let [x, y] = reference(10.0);
        let printed = [(x.position, 7.2197), (y.position, 3.2375), (x.velocity, 6.6683), (y.velocity, -14.3529)];
        for (ours, paper) in printed {
            assert!((ours - paper).abs() < 0.05, "{ours} against {paper}");
        }
    }
}
