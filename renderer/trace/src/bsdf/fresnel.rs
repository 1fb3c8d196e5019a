//! Reflection at a smooth boundary between two dielectrics.

/// Unpolarised Fresnel reflectance.
///
/// `cos_i` is the cosine of the angle of incidence (its absolute value counts), `eta` the
/// refractive index on the far side over that on the near side. 1 under total internal reflection.
pub fn dielectric(cos_i: f32, eta: f32) -> f32 {
    refracted_cosine(cos_i, eta).map_or(1.0, |cos_t| {
        let cos_i = cos_i.abs().min(1.0);
        let parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
        let perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
        0.5 * (parallel * parallel + perpendicular * perpendicular)
    })
}

/// Cosine of the angle of refraction, or `None` under total internal reflection (Snell's law).
pub(crate) fn refracted_cosine(cos_i: f32, eta: f32) -> Option<f32> {
    let sin2_i = (1.0 - cos_i * cos_i).max(0.0);
    let cos2_t = 1.0 - sin2_i / (eta * eta);
    (cos2_t > 0.0).then(|| cos2_t.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_incidence_gives_the_textbook_value() {
        for eta in [1.2_f32, 1.45, 1.5, 2.4] {
            let expected = ((eta - 1.0) / (eta + 1.0)) * ((eta - 1.0) / (eta + 1.0));
            assert!((dielectric(1.0, eta) - expected).abs() < 1e-6);
            assert!((dielectric(1.0, 1.0 / eta) - expected).abs() < 1e-6);
        }
    }

    #[test]
    fn brewsters_angle_reflects_half_of_the_perpendicular_part() {
        let eta = 1.5_f32;
        let cos_i = 1.0 / (1.0 + eta * eta).sqrt();
        let perpendicular = (1.0 - eta * eta) / (1.0 + eta * eta);
        let expected = 0.5 * perpendicular * perpendicular;
        assert!((dielectric(cos_i, eta) - expected).abs() < 1e-6);
    }

    #[test]
    fn beyond_the_critical_angle_everything_is_reflected() {
        let critical = (1.0_f32 - 1.0 / (1.5 * 1.5)).sqrt();
        assert_eq!(dielectric(critical - 0.01, 1.0 / 1.5), 1.0);
        assert!(dielectric(critical + 0.01, 1.0 / 1.5) < 1.0);
    }

    #[test]
    fn both_ways_through_the_boundary_reflect_the_same_share() {
        for cos_i in [0.05_f32, 0.3, 0.7, 0.95] {
            let cos_t = refracted_cosine(cos_i, 1.45).expect("into the denser medium");
            assert!((dielectric(cos_i, 1.45) - dielectric(cos_t, 1.0 / 1.45)).abs() < 1e-5);
        }
    }
}
