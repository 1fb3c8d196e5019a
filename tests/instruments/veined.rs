//! The integrating sphere on grown leaves: what veins do to the mean of a leaf's tissues.

use std::fmt::Write as _;

use glam::{Vec2, Vec3};
use renderer::geometry::Ray;
use renderer::instruments::Row;
use renderer::scene::description::Description;
use renderer::scene::world::World;
use renderer::spectrum::Wavelengths;

use super::{NORMAL, built, figures, of, rays};

/// A preset of a leaf, and the middle of a spot on its midrib, mm from its base.
#[derive(Clone, Copy)]
struct Spot {
    preset: &'static str,
    at_mm: [f64; 2],
}

const BIRCH: Spot = Spot {
    preset: "birch",
    at_mm: [0.0, 25.0],
};

/// Diameter of spots, mm.
const DIAMETER_MM: f64 = 8.0;

/// Keys of a surface without cells, stomata and relief, which lose some light.
const SMOOTH: &str = "[leaves.own.surface]\nimpressed = 0\nraised = 0\nbulge_mm = 0\n\
    cell_share = 0\nstomata.abaxial_per_mm2 = 0\n";

/// Keys of faces without wax: an aspen's abaxial face has some, which sends light back that has passed
/// the tissue.
const WAXLESS: &str = "[leaves.own.surface]\nadaxial_bloom = 0\nabaxial_bloom = 0\n";

/// A grown leaf that lies flat, with a sphere over a part of its midrib.
fn veined(spot: Spot, light_spread: f64, surface: &str) -> String {
    let (preset, [x, y]) = (spot.preset, spot.at_mm);
    format!(
        "[leaves.own]\npreset = \"{preset}\"\nmap_size = 512\nlight_spread = {light_spread}\n\
         [leaves.own.blade]\nfold_deg = 0\ncurl_deg = 0\nruffle = 0\nrelief = 0\npleat_deg = 0\n\
         {surface}\
         [objects.leaf]\nleaf = \"own\"\n\
         [instruments.ball.sphere]\nobject = \"leaf\"\nincidence_deg = [0]\ndiffuse = false\n\
         faces = \"adaxial\"\nwavelengths_nm = [450, 550, 680, 710, 800, 1200, 1650]\n\
         spot = {{ at_mm = [{x}, {y}], diameter_mm = {DIAMETER_MM} }}\n"
    )
}

/// R and T that PROSPECT gives the contents at points of a spot, which are as far apart as texels:
/// their means, by wavelength.
fn mean_of_tissues(scene: &Description, world: &World, spot: Spot) -> Vec<[f64; 2]> {
    let nm = &scene.instruments[0].value.wavelengths_nm;
    let (mut sums, mut count) = (vec![[0.0; 2]; nm.len()], 0.0);
    let side = 200;
    let diameter = DIAMETER_MM as f32 * 1e-3;
    let middle = spot.at_mm.map(|mm| mm as f32 * 1e-3);
    for i in 0..side * side {
        let place = Vec2::new((i % side) as f32, (i / side) as f32) + 0.5;
        let place = (place / side as f32 - 0.5) * diameter;
        if place.length() > 0.5 * diameter {
            continue;
        }
        let above = Vec3::new(middle[0] + place.x, middle[1] + place.y, 0.1);
        let ray = Ray::new(above, Vec3::NEG_Z);
        let hit = world
            .geometry
            .intersect(&ray)
            .expect("the spot is on the leaf");
        let surface = world.geometry.surface(&hit);
        let tissue = world.material_of(hit.instance).tissue();
        let tissue = tissue.expect("a leaf is tissue");
        let texel = tissue.held.expect("it has contents").at(surface.uv);
        count += 1.0;
        for (sums, &nm) in sums.iter_mut().zip(nm) {
            let pile = tissue.palette.lanes(&Wavelengths::new([nm as f32]));
            let (r, t) = pile.reflectance_transmittance(&texel);
            sums[0] += f64::from(r[0]);
            sums[1] += f64::from(t[0]);
        }
    }
    let means = sums.into_iter().map(|sums| sums.map(|sum| sum / count));
    means.collect()
}

fn read<'r>(rows: &'r [Row], quantity: &'static str, nm: f64) -> &'r Row {
    of(rows, quantity, NORMAL, nm)
        .next()
        .expect("it is measured")
}

#[test]
#[ignore = "deep: 6 s"]
fn a_veined_leaf_reads_the_mean_of_its_tissues_but_for_light_that_spreads_under_veins() {
    let text = veined(BIRCH, 0.0, SMOOTH);
    let rows = figures(&text, &rays(1 << 17)).expect("it can be measured");
    let (scene, world, _) = built(&text);
    let nm = &scene.instruments[0].value.wavelengths_nm;
    let means = mean_of_tissues(&scene, &world, BIRCH);
    let mut report = String::new();
    let mut greatest = 0.0_f64;
    for (means, &nm) in means.iter().zip(nm) {
        for (quantity, mean) in ["reflectance", "transmittance"].into_iter().zip(means) {
            let row = read(&rows, quantity, nm);
            let off = row.value - mean;
            greatest = greatest.max(off.abs());
            let _ = writeln!(report, "{nm} nm {quantity}: {:.4}, {off:+.4}", row.value);
        }
    }
    // 1e-3 beyond the noise of the sphere and of the grid of points.
    assert!(greatest < 2e-3, "{report}");
    // Light that spreads sideways leaves R as it is and changes T where neighbours differ.
    let spread = figures(&veined(BIRCH, 1.0, SMOOTH), &rays(1 << 17)).expect("it can be measured");
    for &nm in nm {
        let both = |quantity: &'static str| {
            let [a, b] = [&rows, &spread].map(|rows| read(rows, quantity, nm).clone());
            (a.value, b.value, a.error.hypot(b.error))
        };
        let (alone, spread, error) = both("reflectance");
        assert!(
            (alone - spread).abs() < 5.0 * error + 1e-4,
            "{nm} nm: {alone} {spread}"
        );
        // A gain: where little comes through, more comes in from beside than goes out.
        let (alone, spread, error) = both("transmittance");
        assert!(spread > alone - 5.0 * error, "{nm} nm: {alone} {spread}");
        if nm == 450.0 {
            assert!(spread > 1.1 * alone, "{nm} nm: {alone} {spread}");
        }
    }
}

/// The table of the book: the sphere on leaves as they are, with all that their presets say of the
/// surface, less the mean of their tissues.
#[test]
#[ignore = "deep: a minute"]
fn leaves_of_several_species_differ_from_the_mean_of_their_tissues_by_what_veins_do() {
    let spot = |preset, at_mm| Spot { preset, at_mm };
    let leaves = [
        BIRCH,
        spot("aspen", [0.0, 25.0]),
        spot("cottonwood", [0.0, 30.0]),
        spot("magnolia", [0.0, 60.0]),
    ];
    let mut report =
        "| leaf | nm | R | − mean | T | − mean | T, light straight on, no wax | − mean |\n\
        |---|---|---|---|---|---|---|---|\n"
            .to_owned();
    for leaf in leaves {
        let text = veined(leaf, 1.0, "");
        let rows = figures(&text, &rays(1 << 16)).expect("it can be measured");
        let straight = veined(leaf, 0.0, WAXLESS);
        let straight = figures(&straight, &rays(1 << 16)).expect("it can be measured");
        let (scene, world, _) = built(&text);
        let means = mean_of_tissues(&scene, &world, leaf);
        let nm = &scene.instruments[0].value.wavelengths_nm;
        for ([r, t], &nm) in means.iter().zip(nm) {
            let [back, through] =
                ["reflectance", "transmittance"].map(|quantity| read(&rows, quantity, nm));
            let plain = read(&straight, "transmittance", nm);
            let _ = writeln!(
                report,
                "| {} | {nm} | {:.4} | {:+.4} | {:.4} | {:+.4} | {:.4} | {:+.4} |",
                leaf.preset,
                back.value,
                back.value - r,
                through.value,
                through.value - t,
                plain.value,
                plain.value - t
            );
            // Relief takes up to 1 % of the light that passes, which counts as absorbed; of R what
            // coats throw to where the relief hides it.
            let slack = 4.0 * back.error + 1e-3 + 0.005 * r;
            assert!(
                (back.value - r).abs() < slack,
                "{}: {back:?} {r}",
                leaf.preset
            );
            let slack = 4.0 * plain.error + 5e-4 + 0.015 * t;
            assert!(
                (plain.value - t).abs() < slack,
                "{}: {plain:?} {t}",
                leaf.preset
            );
        }
    }
    eprintln!("{report}");
}
