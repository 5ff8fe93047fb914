//! The gyroscopic moment τ_g = -ω × I ω of (8), taken as an input beside the torque: I ω' = τ + τ_g.

use crate::moments::InputMoments;
use crate::readout::Parameter;

/// γ = I_j - I_k of each axis, so that τ_g = γ ω_j ω_k.
pub(super) fn differences([ix, iy, iz]: &[f32; 3]) -> [f32; 3] {
    [iy - iz, iz - ix, ix - iy]
}

/// γ of each axis, and its variance. `k` is 1/I where it is identified, else `guesses`: first guesses of moments of inertia are
/// taken to be off by half of themselves, two of them together. Where there is no guess either γ is taken for zero: of any body
/// |I_j - I_k| ≤ I_i, which is what it may be off by.
pub(super) fn differences_known(k: &[Option<Parameter>; 3], guesses: &[Option<f32>; 3]) -> ([f32; 3], [f32; 3]) {
    let (mut inertias, mut variances, mut unknown) = ([0.0; 3], [0.0; 3], [false; 3]);
    let of_axes = inertias.iter_mut().zip(&mut variances).zip(&mut unknown);
    for ((((inertia, variance), unknown), k), guess) in of_axes.zip(k).zip(guesses) {
        let guessed = guess.map(|guess| Parameter { value: guess, variance: 0.25 * guess * guess });
        if let Some(k) = k.or(guessed) {
            *inertia = 1.0 / k.value;
            let square = *inertia * *inertia;
            *variance = (k.variance * square) * square;
        } else {
            *unknown = true;
        }
    }
    let mut gammas = differences(&inertias);
    let [x, y, z] = variances;
    let [p, q, r] = k.map(|k| k.is_none());
    let mut of_gammas = [y + z, z + x, x + y];
    for ((variance, both), gamma) in of_gammas.iter_mut().zip([q && r, r && p, p && q]).zip(&gammas) {
        if both {
            *variance = 0.25 * gamma * gamma;
        }
    }
    let [p, q, r] = unknown;
    let each = gammas.iter_mut().zip(&mut of_gammas).zip(&inertias);
    for (((gamma, variance), inertia), any) in each.zip([q || r, r || p, p || q]) {
        if any {
            (*gamma, *variance) = (0.0, inertia * inertia);
        }
    }
    (gammas, of_gammas)
}

/// ω_j ω_k of each axis.
pub(super) fn products([p, q, r]: &[f32; 3]) -> [f32; 3] {
    [q * r, r * p, p * q]
}

/// ω_j ω_k in the middle of a control period that begins with the body rates `rates` and through which `torque` acts on the
/// mean: to second order of the period. `k` is 1/I, `differences` γ.
fn products_in_the_middle(
    differences: &[f32; 3],
    k: &[f32; 3],
    rates: &[f32; 3],
    torque: &[f32; 3],
    half_period: f32,
) -> [f32; 3] {
    let mut middle = *rates;
    let own = products(rates).into_iter().zip(differences);
    for (((rate, k), applied), (product, gamma)) in middle.iter_mut().zip(k).zip(torque).zip(own) {
        *rate += half_period * (k * (applied + gamma * product));
    }
    products(&middle)
}

/// ω_j ω_k and γ of a period.
pub(super) struct Gyroscopic {
    pub products: [f32; 3],
    pub differences: [f32; 3],
}

impl Gyroscopic {
    /// Adds τ_g to the torque, held at its value in the middle of the period.
    pub fn add(torque: &mut [InputMoments; 3], rates: &[f32; 3], k: &[f32; 3], half_period: f32) -> Self {
        let gammas = differences(&k.map(|k| 1.0 / k));
        let mean = torque.map(|t| t.j1);
        let products = products_in_the_middle(&gammas, k, rates, &mean, half_period);
        for (moment, (product, gamma)) in torque.iter_mut().zip(products.iter().zip(&gammas)) {
            let f = gamma * product;
            moment.j1 += f;
            moment.j2 += 0.5 * f;
        }
        Self { products, differences: gammas }
    }
}
