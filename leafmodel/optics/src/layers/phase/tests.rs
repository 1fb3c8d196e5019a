use super::*;
use crate::layers::boundary::polarised;
use crate::quadrature::gauss;

#[test]
fn moments_and_samples_are_those_of_the_phase_function() {
    let double = Phase::Double {
        first: 0.8,
        second: -0.4,
        share: 0.7,
    };
    let some = [0.0, 5e-5, -0.5, 0.9].map(|g| Phase::HenyeyGreenstein { g });
    let rule = gauss(200);
    for phase in some.into_iter().chain([double, Phase::Rayleigh]) {
        let integral = |f: &dyn Fn(f64) -> f64| -> f64 {
            let halves = rule.iter().flat_map(|(x, w)| [(-*x, *w), (*x, *w)]);
            halves.map(|(x, w)| 0.5 * w * phase.value(x) * f(x)).sum()
        };
        let moments = phase.moments(4);
        assert!((integral(&|_| 1.0) - 1.0).abs() < 1e-9, "{phase:?}");
        assert!((integral(&|x| x) - moments[1]).abs() < 1e-9);
        assert!((integral(&|x| 1.5 * x * x - 0.5) - moments[2]).abs() < 1e-9);
        assert!((integral(&|x| 2.5 * x * x * x - 1.5 * x) - moments[3]).abs() < 1e-9);
        // Means over evenly spread numbers.
        let n = 1000;
        let mut means = [0.0; 2];
        for i in 0..n {
            for j in 0..10 {
                let x = phase.sample(
                    (f64::from(i) + 0.5) / f64::from(n),
                    (f64::from(j) + 0.5) / 10.0,
                );
                means[0] += x / f64::from(10 * n);
                means[1] += (1.5 * x * x - 0.5) / f64::from(10 * n);
            }
        }
        assert!((means[0] - moments[1]).abs() < 1e-5, "{phase:?} {means:?}");
        assert!((means[1] - moments[2]).abs() < 1e-5, "{phase:?} {means:?}");
    }
}

/// The mean cosine behind a ball, by rays that are followed one reflection at a time.
fn followed_through_ball(index: f64) -> f64 {
    let (mut mean, n) = (0.0, 20_000);
    for i in 0..n {
        // Rays spread evenly over the ball's disc.
        let sine = ((f64::from(i) + 0.5) / f64::from(n)).sqrt();
        let (outer, inner) = (libm::asin(sine), libm::asin(sine / index));
        let (s, p) = polarised(1.0, index, libm::cos(outer), libm::cos(inner));
        for r in [s, p] {
            mean += 0.5 * r * -libm::cos(2.0 * outer);
            let mut left = 1.0 - r;
            let mut turned = 2.0 * (outer - inner);
            while left > 1e-12 {
                mean += 0.5 * left * (1.0 - r) * libm::cos(turned);
                left *= r;
                turned += PI - 2.0 * inner;
            }
        }
    }
    mean / f64::from(n)
}

#[test]
fn a_ball_throws_light_as_rays_that_are_followed_through_it() {
    for index in [1.05, 1.333, 1.5] {
        let (closed, followed) = (mean_cosine_of_ball(index), followed_through_ball(index));
        assert!(
            (closed - followed).abs() < 2e-4,
            "{index}: {closed} {followed}"
        );
    }
}

#[test]
fn a_wall_reflects_what_two_faces_do() {
    let (share, cosine) = wall(1.5);
    // One face reflects 0.0918 of diffuse light, [leaf optics]; both nearly twice as much.
    assert!((0.14..0.17).contains(&share), "{share}");
    assert!((-1.0..1.0).contains(&cosine), "{cosine}");
    assert!(wall(1.0 + 1e-9).0 < 1e-3);
}
