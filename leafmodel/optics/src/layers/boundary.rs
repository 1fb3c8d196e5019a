//! A smooth boundary between two media.

/// Reflectances for light polarised across and along the plane of incidence, between a medium of
/// index `from`, where the direction has the cosine `cosine`, and one of index `to`, where it has
/// `refracted`.
pub(super) fn polarised(from: f64, to: f64, cosine: f64, refracted: f64) -> (f64, f64) {
    let across = (from * cosine - to * refracted) / (from * cosine + to * refracted);
    let along = (to * cosine - from * refracted) / (to * cosine + from * refracted);
    (across * across, along * along)
}

/// Unpolarised reflectance, by Fresnel's formulae.
pub(super) fn reflectance(from: f64, to: f64, cosine: f64, refracted: f64) -> f64 {
    if from == to {
        return 0.0;
    }
    let (across, along) = polarised(from, to, cosine, refracted);
    f64::midpoint(across, along)
}
