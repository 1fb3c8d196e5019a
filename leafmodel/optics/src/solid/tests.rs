use super::*;
use crate::Contents;
use crate::ProspectD;

#[test]
fn half_spaces_reflect_what_the_reference_solutions_say() {
    // n, a, normal, diffuse: Chandrasekhar's H for n = 1, discrete ordinates split at the critical
    // angle for n = 1.5.
    for (eta, a, normal, diffuse) in [
        (1.0, 0.5, 0.115226, 0.146544),
        (1.0, 0.9, 0.414947, 0.478024),
        (1.0, 0.99, 0.752721, 0.794564),
        (1.0, 0.999, 0.912845, 0.929713),
        (1.5, 0.9, 0.259919, 0.307890),
    ] {
        let got = HalfSpace::new(eta).reflected(a, 0.0);
        assert!((got.normal - normal).abs() < 1e-6, "{eta} {a} {got:?}");
        assert!((got.diffuse - diffuse).abs() < 1e-6, "{eta} {a} {got:?}");
    }
}

#[test]
fn without_scattering_fresnels_reflection_remains_and_without_absorption_all_comes_back() {
    for eta in [1.0, 1.2, 1.38, 1.5] {
        let space = HalfSpace::new(eta);
        let fresnel = ((eta - 1.0) / (eta + 1.0)).powi(2);
        assert!((space.reflected(0.0, 0.0).normal - fresnel).abs() < 1e-14);
        assert!((space.reflected(0.9999, 50.0).normal - fresnel).abs() < 1e-14);
        let all = space.reflected(1.0, 0.0);
        assert!((all.normal - 1.0).abs() < 1e-5, "{eta}: {all:?}");
        assert!((all.diffuse - 1.0).abs() < 1e-5, "{eta}: {all:?}");
    }
}

#[test]
fn reflectance_grows_with_albedo_and_falls_with_the_skin() {
    let space = HalfSpace::new(ETA);
    let mut before = 0.0;
    for i in 0..=20 {
        let a = 1.0 - libm::pow(1.0 - f64::from(i) / 20.0, 3.0);
        let bare = space.reflected(a, 0.0);
        assert!(bare.normal > before && bare.normal <= 1.0);
        before = bare.normal;
        if i > 0 {
            let skinned = space.reflected(a, 0.2);
            assert!(skinned.normal < bare.normal && skinned.diffuse < bare.diffuse);
        }
    }
}

#[test]
fn the_table_is_off_by_less_than_it_says() {
    for (eta, skin) in [(1.0, 0.0), (ETA, 0.0), (1.5, 0.3)] {
        let (table, space) = (ReflectanceTable::new(eta, skin), HalfSpace::new(eta));
        let mut worst = 0.0_f64;
        for i in 0..400 {
            let s = (f64::from(i) + 0.37) / 400.0;
            let a = 1.0 - s * s * s;
            worst = worst.max((table.at(a) - space.reflected(a, skin).normal).abs());
        }
        assert!(worst < 1e-7, "{eta} {skin}: {worst:e}");
    }
}

#[test]
fn contents_spread_over_twice_the_depth_absorb_half_as_much() {
    let contents = Contents::new(1.0, 10.0, 2.0, 0.0, 0.0, 0.1, 0.0).expect("valid");
    let solid = Solid {
        depth_mm: 1.0,
        scattering_per_mm: SCATTERING_PER_MM,
        eta: ETA,
    };
    let at = ProspectD::coefficients(680.0).expect("in range");
    let whole = at.absorption_of_leaf(&contents);
    let two = Solid {
        depth_mm: 2.0,
        ..solid
    };
    assert!((solid.albedo_of(whole) - 1.5 / (1.5 + whole)).abs() < 1e-15);
    assert!((two.albedo_of(whole) - 1.5 / (1.5 + 0.5 * whole)).abs() < 1e-15);
}

#[test]
fn parameters_out_of_range_are_refused_by_name() {
    let good = Solid {
        depth_mm: 1.0,
        scattering_per_mm: 1.0,
        eta: 1.4,
    };
    assert!(good.checked().is_ok());
    let field = |solid: Solid| solid.checked().expect_err("it is wrong").field;
    let (depth_mm, scattering_per_mm, eta) = (0.0, f64::INFINITY, 0.9);
    assert_eq!(field(Solid { depth_mm, ..good }), "depth_mm");
    assert_eq!(
        field(Solid {
            scattering_per_mm,
            ..good
        }),
        "scattering_per_mm"
    );
    assert_eq!(field(Solid { eta, ..good }), "eta");
}
