//! Which lights are sampled at a point.

use crate::light::Light;
use crate::sampling::distribution::Piecewise1d;

/// Lights sorted by how they are sampled.
///
/// Suns are small and strong, so each is sampled at every vertex; of all other lights with an extent that
/// can be drawn, one is chosen by its power; a constant sky is left to the bounces, which find it best.
#[derive(Clone, Debug)]
pub struct LightSelection {
    /// Lights sampled at every vertex.
    pub always: Box<[usize]>,
    /// Lights of which one is chosen.
    pub chosen: Box<[usize]>,
    /// Probability of choosing each light, by its number; 1 for suns, 0 for those left to the bounces.
    probability: Box<[f32]>,
    by_power: Option<Piecewise1d>,
}

impl LightSelection {
    /// For lights with the given rough powers, W nm⁻¹.
    pub fn new(lights: &[Light], powers: &[f32]) -> Self {
        let mut always = Vec::new();
        let mut chosen = Vec::new();
        for (number, light) in lights.iter().enumerate() {
            match light {
                Light::Distant(_) => always.push(number),
                Light::Environment(_) | Light::Area(_) => chosen.push(number),
                Light::Constant(_) => {}
            }
        }
        let weights: Vec<f32> = chosen.iter().map(|&number| powers[number]).collect();
        let by_power = (!chosen.is_empty()).then(|| Piecewise1d::new(&weights));
        let mut probability = vec![0.0; lights.len()];
        for &number in &always {
            probability[number] = 1.0;
        }
        if let Some(by_power) = &by_power {
            for (place, &number) in chosen.iter().enumerate() {
                probability[number] = by_power.probability(place);
            }
        }
        Self {
            always: always.into(),
            chosen: chosen.into(),
            probability: probability.into(),
            by_power,
        }
    }

    /// Chooses one of the lights that share a sample; also gives what is left of `u`.
    pub fn choose(&self, u: f32) -> Option<(usize, f32)> {
        let (place, within) = self.by_power.as_ref()?.sample(u);
        Some((self.chosen[place], within))
    }

    /// Probability that a light is sampled at a vertex.
    pub fn probability(&self, light: usize) -> f32 {
        self.probability[light]
    }
}
