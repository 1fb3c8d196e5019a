//! Media against closed forms.

use std::f64::consts::PI;
use std::path::Path;

use glam::{Vec2, Vec3};
use renderer::medium::Phase;
use renderer::sampling::stream::Stream;
use renderer::scene::load::parse;
use renderer::scene::world::World;
use support::chi_square::{ChiSquare, sidak};
use support::picture::{mean_and_error, mean_of, means_and_errors, picture_of};

/// A scene of two bands seen straight from above by parallel rays, to which blocks are added.
fn scene(integrator: &str, blocks: &str) -> String {
    format!(
        "format = 1\n\
         [film.spectral]\nsize = [8, 8]\nspp = 64\nbands_nm = [550, 800]\nband_width_nm = 0\n\
         filter_radius_px = 0\n\
         [camera.orthographic]\nposition_m = [0, 0, 2]\nlook_at_m = [0, 0, 0]\nup = [0, 1, 0]\n\
         height_m = 0.2\n[integrator]\n{integrator}\n{blocks}"
    )
}

/// A slab of thickness 0.5 m and 400 m across, filled with a medium of these keys.
fn slab(eta: f64, medium: &str) -> String {
    format!(
        "[media.fill]\n{medium}\n[materials.slab.dielectric]\neta = {eta}\ninterior = \"fill\"\n\
         [meshes.slab.box]\nsize_m = [400, 400, 0.5]\n\
         [objects.slab]\nmesh = \"slab\"\nmaterial = \"slab\"\n"
    )
}

const SKY: &str = "[lights.sky.constant]\nradiance_w_m2_sr_nm = 1\n";

/// Asserts that a mean lies within four of its standard errors, and that those are at most a share
/// of it.
fn assert_agrees(what: &str, (mean, error): (f64, f64), expected: f64, most: f64) {
    eprintln!("{what}: {mean:.6} ± {error:.1e}, expected {expected:.6}");
    assert!(error <= most * expected, "{what}: ± {error}");
    let allowed = 4.0 * error + 2e-5 * expected;
    assert!(
        (mean - expected).abs() < allowed,
        "{what}: {mean} ± {error}, not {expected}"
    );
}

#[test]
fn a_clear_absorbing_box_obeys_beer_and_lambert_without_noise() {
    let medium = "absorption_per_m = { table = [[550, 1], [800, 4]] }";
    let picture = picture_of(&scene("", &format!("{}{SKY}", slab(1.0, medium))), 1);
    for (channel, absorption) in [1.0, 4.0].into_iter().enumerate() {
        let expected = f64::exp(-0.5 * absorption);
        let means = picture.film.map(|pixel| pixel.mean(channel));
        for mean in means {
            assert!((mean - expected).abs() < 1e-6, "{mean} is not {expected}");
        }
    }
}

#[test]
fn a_pane_of_absorbing_glass_transmits_and_reflects_as_its_faces_and_its_depth_say() {
    // The sky above and below: what comes up is T + R of a plate of two faces.
    let medium = "absorption_per_mm = { table = [[550, 1e-3], [800, 4e-3]] }";
    let text = scene("", &format!("{}{SKY}", slab(1.5, medium))).replace("spp = 64", "spp = 1024");
    let found: [_; 2] = means_and_errors(&text, 8);
    for (found, absorption) in found.into_iter().zip([1.0, 4.0]) {
        let (r, inner) = (0.04, f64::exp(-0.5 * absorption));
        let transmitted = (1.0 - r) * (1.0 - r) * inner / (1.0 - r * r * inner * inner);
        let expected = r + transmitted * (1.0 + r * inner);
        let reflected =
            r + (1.0 - r) * (1.0 - r) * r * inner * inner / (1.0 - r * r * inner * inner);
        assert!((expected - (reflected + transmitted)).abs() < 1e-12);
        assert_agrees("a pane", found, expected, 2e-3);
    }
}

#[test]
fn a_furnace_is_one_through_and_inside_of_media_that_absorb_nothing() {
    let even = "scattering_per_m = 6\ng = 0.6";
    let coloured = "scattering_per_m = { table = [[550, 2], [800, 12]] }\nphase = \"rayleigh\"";
    let tank = |eta: &str, medium: &str| {
        format!(
            "[media.milk]\n{medium}\n[materials.milk.dielectric]\n{eta}\ninterior = \"milk\"\n\
             [meshes.tank.box]\nsize_m = [0.6, 0.5, 0.4]\n\
             [objects.tank]\nmesh = \"tank\"\nmaterial = \"milk\"\nrotate_deg = [20, 30, 0]\n{SKY}"
        )
    };
    // Every path has the weight 1 where no wavelength is scattered more than another, and the coin
    // of roulette is not tossed: there is no noise at all.
    for eta in ["eta = 1", "eta = 1.4"] {
        let text = scene("roulette_below = 0", &tank(eta, even));
        for pixel in picture_of(&text, 2)
            .film
            .map(|pixel| [0, 1].map(|c| pixel.mean(c)))
        {
            assert!(
                pixel.iter().all(|mean| (mean - 1.0).abs() < 1e-4),
                "{eta}: {pixel:?}"
            );
        }
    }
    // A rough boundary loses what its microfacets would scatter more than once, each time that light
    // is sent back inside: 1.4 % at 0.05.
    for (roughness, loss) in [(0.01, 5e-3), (0.05, 2e-2)] {
        let rough = format!("eta = 1.4\nroughness = {roughness}");
        let found = mean_and_error(&scene("", &tank(&rough, even)), 0, 8);
        let lost = 1.0 - found.0;
        assert!(
            lost > -4.0 * found.1 && lost < loss + 4.0 * found.1,
            "{roughness}: {found:?}"
        );
    }
    for eta in ["eta = 1", "eta = 1.4"] {
        for found in means_and_errors::<2>(&scene("", &tank(eta, coloured)), 24) {
            assert_agrees("a coloured tank", found, 1.0, 5e-3);
        }
    }
    // Inside, radiance is η² of that outside: 1 without a change of index.
    for (eta, inside) in [("eta = 1", 1.0), ("eta = 1.4", 1.96)] {
        let text = scene("roulette_below = 0", &tank(eta, even)).replace("0, 0, 2]", "0, 0, 0.1]");
        let mean = mean_of(&picture_of(&text, 3), 0);
        assert!((mean - inside).abs() < 2e-4, "{eta}: {mean}");
    }
}

#[test]
fn a_slab_scatters_once_what_the_equation_of_transfer_says() {
    // Irradiance E across the beam from the zenith angle θ₀, seen along the normal, after a single
    // event: L = a p E μ₀ / (1 + μ₀) (1 − exp(−τ (1 + 1/μ₀))). The cosine of the angle between the
    // ways before and after is −μ₀.
    let medium = "absorption_per_m = { table = [[550, 1], [800, 0]] }\n\
        scattering_per_m = { table = [[550, 3], [800, 0.5]] }\n";
    let mu = f64::to_radians(40.0).sin();
    let sun =
        "[lights.sun.distant]\nirradiance_w_m2_nm = 2\nelevation_deg = 40\nazimuth_deg = 30\n";
    for (phase, value) in [
        (
            "g = 0.4",
            (1.0 - 0.16) / (4.0 * PI * (1.0 + 0.16 + 0.8 * mu).powf(1.5)),
        ),
        ("phase = \"rayleigh\"", 3.0 / (16.0 * PI) * (1.0 + mu * mu)),
    ] {
        let blocks = format!("{}{sun}", slab(1.0, &format!("{medium}{phase}")));
        let text = scene("max_depth = 1", &blocks);
        let found: [_; 2] = means_and_errors(&text, 8);
        for (found, [a, s]) in found.into_iter().zip([[1.0, 3.0], [0.0, 0.5]]) {
            let (extinction, depth) = (a + s, 0.5 * (a + s));
            let lost = 1.0 - f64::exp(-depth * (1.0 + 1.0 / mu));
            let expected = s / extinction * value * 2.0 * mu / (1.0 + mu) * lost;
            assert_agrees(phase, found, expected, 3e-3);
        }
    }
}

#[test]
fn lamps_are_found_by_samples_and_by_bounces_with_weights_that_add_up() {
    // A wide lamp close to a slab: at a medium's vertex both find it. Its samples alone are those
    // of many small lamps in its place, which hardly any bounce hits.
    let medium = "scattering_per_m = 2\nabsorption_per_m = 1\ng = 0.5";
    let lamp = |count: u32| {
        let size = 0.8 / f64::from(count);
        let mut text = format!(
            "[meshes.lamp.rectangle]\nwidth_m = {size}\nheight_m = {size}\n\
             [materials.black.diffuse]\nreflectance = 0\n"
        );
        for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))) {
            let place = |k: u32| (f64::from(k) + 0.5) * size - 0.4;
            text += &format!(
                "[objects.l{i}-{j}]\nmesh = \"lamp\"\nmaterial = \"black\"\n\
                 position_m = [{}, {}, -0.5]\n[lights.l{i}-{j}.area]\nobject = \"l{i}-{j}\"\n\
                 radiance_w_m2_sr_nm = 1\n",
                place(i),
                place(j)
            );
        }
        scene("", &format!("{}{text}", slab(1.0, medium))).replace("spp = 64", "spp = 512")
    };
    let [one, many] = [1, 4].map(|count| mean_and_error(&lamp(count), 0, 8));
    let error = one.1.hypot(many.1);
    eprintln!("{one:?} {many:?}");
    assert!(error < 5e-3 * one.0, "{one:?} {many:?}");
    assert!((one.0 - many.0).abs() < 4.0 * error, "{one:?} {many:?}");
}

#[test]
fn a_filter_dims_the_light_behind_it_and_a_clear_body_inside_makes_it_thinner() {
    // A floor under the sun, through the slab there and back; in the slab a clear box 0.2 m high.
    let medium = "absorption_per_m = { table = [[550, 1], [800, 2]] }";
    let floor = "[meshes.floor.rectangle]\nwidth_m = 400\nheight_m = 400\n\
        [materials.grey.diffuse]\nreflectance = 0.5\n\
        [objects.floor]\nmesh = \"floor\"\nmaterial = \"grey\"\nposition_m = [0, 0, -1]\n\
        [lights.sun.distant]\nirradiance_w_m2_nm = 1\nelevation_deg = 30\n";
    let hollow = "[materials.clear.dielectric]\neta = 1\n\
        [meshes.hollow.box]\nsize_m = [300, 300, 0.2]\n\
        [objects.hollow]\nmesh = \"hollow\"\nmaterial = \"clear\"\n";
    for (inner, thickness) in [("", 0.5), (hollow, 0.3)] {
        let text = scene("", &format!("{}{floor}{inner}", slab(1.0, medium)));
        let found: [_; 2] = means_and_errors(&text, 4);
        for (found, absorption) in found.into_iter().zip([1.0, 2.0]) {
            // Up along the normal, down at a slope of 1 : 2.
            let expected = 0.5 / PI * 0.5 * f64::exp(-absorption * thickness * 3.0);
            // The sun is a disc; the mean of exp(−τ/μ) over it differs by 1e-5.
            assert_agrees("a filter", found, expected, 1e-3);
        }
    }
}

#[test]
fn inclined_leaves_scatter_once_what_the_integral_over_their_normals_says() {
    type Density = fn(f64) -> f64;
    // Leaves of the area u that turn the fractions G to the sun and to the camera send there, of the irradiance E across the
    // beam, after a single event: L = E Γ / π (1 − exp(−u h (G₀ / μ₀ + G))) / (G₀ / μ₀ + G), where Γ is the mean of
    // ρ or τ times both cosines, ρ where they see one face.
    let (mu, lai) = (f64::to_radians(40.0).sin(), 1.5);
    let leaves = [[0.4, 0.1], [0.05, 0.6]];
    let sun =
        "[lights.sun.distant]\nirradiance_w_m2_nm = 2\nelevation_deg = 40\nazimuth_deg = 30\n";
    let densities: [(&str, Density); 3] = [
        ("planophile", |angle| 1.0 + (2.0 * angle).cos()),
        ("erectophile", |angle| 1.0 - (2.0 * angle).cos()),
        ("extremophile", |angle| 1.0 + (4.0 * angle).cos()),
    ];
    for (inclination, density) in densities {
        let (mut all, mut towards, mut gamma) = (0.0, [0.0; 2], [0.0; 2]);
        let (steps, around) = (800, 800);
        for step in 0..steps {
            let angle = 0.5 * PI * (f64::from(step) + 0.5) / f64::from(steps);
            for turn in 0..around {
                let azimuth = 2.0 * PI * (f64::from(turn) + 0.5) / f64::from(around);
                let weight = density(angle);
                let to_sun =
                    angle.cos() * mu + angle.sin() * (1.0 - mu * mu).sqrt() * azimuth.cos();
                let to_camera = angle.cos();
                all += weight;
                towards[0] += weight * to_sun.abs();
                towards[1] += weight * to_camera;
                gamma[usize::from(to_sun < 0.0)] += weight * to_sun.abs() * to_camera;
            }
        }
        let medium = format!(
            "[media.fill.leaves]\narea_m2_per_m3 = {}\ninclination = \"{inclination}\"\n\
             reflectance = {{ table = [[550, 0.4], [800, 0.05]] }}\n\
             transmittance = {{ table = [[550, 0.1], [800, 0.6]] }}",
            lai / 0.5
        );
        let blocks = format!("{}{sun}", slab(1.0, &medium).replace("[media.fill]\n", ""));
        let found: [_; 2] = means_and_errors(&scene("max_depth = 1", &blocks), 16);
        for (found, [reflected, passed]) in found.into_iter().zip(leaves) {
            let depth = (towards[0] / mu + towards[1]) / all;
            let sent = (reflected * gamma[0] + passed * gamma[1]) / all;
            let expected = 2.0 * sent / PI * (1.0 - f64::exp(-lai * depth)) / depth;
            assert_agrees(inclination, found, expected, 1e-2);
        }
    }
}

#[test]
fn phase_functions_are_sampled_as_their_densities_say() {
    const CHI_SQUARE: ChiSquare = ChiSquare {
        rings: 40,
        spokes: 24,
        draws: 200_000,
        midpoints: 8,
    };
    let way = Vec3::new(0.48, -0.6, 0.64);
    let cases = [0.0, 1e-5, 0.3, -0.5, 0.75, 0.9].map(|g| Phase::HenyeyGreenstein { g });
    let cases: Vec<Phase> = cases.into_iter().chain([Phase::Rayleigh]).collect();
    let level = sidak(0.01, cases.len());
    for phase in cases {
        let draw = |number: usize| {
            // Of different pixels, so independent.
            let [x, y, lobe, _] = Stream::new(4, number as u32, 1, 0).next4();
            Some(phase.sample(way, lobe, Vec2::new(x, y)).direction)
        };
        let outcome = CHI_SQUARE.run(draw, |direction| phase.value(way, direction));
        assert!(outcome.p_value > level, "{phase:?}: {outcome}");
        assert!(
            (outcome.total_density - 1.0).abs() < 1e-2,
            "{phase:?}: {outcome}"
        );
    }
    // A density that is 4 % off in its asymmetry is found.
    let phase = Phase::HenyeyGreenstein { g: 0.75 };
    let draw = |number: usize| {
        let [x, y, lobe, _] = Stream::new(4, number as u32, 1, 0).next4();
        Some(phase.sample(way, lobe, Vec2::new(x, y)).direction)
    };
    let other = Phase::HenyeyGreenstein { g: 0.72 };
    let outcome = CHI_SQUARE.run(draw, |direction| other.value(way, direction));
    assert!(outcome.p_value < 1e-6, "{outcome}");
}

#[test]
fn pictures_with_media_have_the_same_bits_on_any_number_of_threads() {
    let medium =
        "scattering_per_m = { table = [[550, 4], [800, 9]] }\nabsorption_per_m = 0.4\ng = 0.7";
    let sun = "[lights.sun.distant]\nirradiance_w_m2_nm = 2\nelevation_deg = 40\n";
    for eta in [1.0, 1.33] {
        let text = scene("", &format!("{}{sun}{SKY}", slab(eta, medium)));
        let run = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let picture = pool
                .expect("there are threads")
                .install(|| picture_of(&text, 5));
            picture
                .film
                .map(|pixel| [0, 1].map(|c| pixel.mean(c).to_bits()))
        };
        let one = run(1);
        assert_eq!(one, run(2));
        assert_eq!(one, run(3));
    }
}

#[test]
fn a_medium_in_an_open_mesh_is_refused() {
    let text = slab(1.33, "absorption_per_m = 1");
    let sheet = text.replace(
        "box]\nsize_m = [400, 400, 0.5]",
        "rectangle]\nwidth_m = 1\nheight_m = 1",
    );
    let loaded = parse(
        &scene("", &format!("{sheet}{SKY}")),
        "open.toml",
        Path::new("."),
        &[],
    );
    let loaded = loaded.unwrap_or_else(|errors| panic!("{errors}"));
    let error = World::build(&loaded.description).expect_err("the sheet encloses nothing");
    let told = error.to_string();
    assert!(
        told.starts_with("objects.slab: its mesh does not enclose a body"),
        "{told}"
    );
}
