//! Slabs and half-spaces of media against the table of anchors, by the paths of instruments through
//! real bodies.

use renderer::instruments::{Budget, Direction, Problem};

use super::{NORMAL, figures, of, rays};

/// Reflectance and transmittance of layers. The file says how they were computed.
const REFERENCE: &str = include_str!("../data/transport_anchors.csv");

/// Thickness of the slabs, m, and side of the box that repeats itself. What counts is the optical
/// depth; light that goes nearly along a slab comes by the same sides many times.
const THICKNESS: f64 = 1.0;
const SIDE: f64 = 8.0;

/// Optical depth that stands for infinity. Deep inside a medium that scatters evenly, radiance falls
/// off as exp(−k τ) with a/(2k) ln((1 + k)/(1 − k)) = 1: k is 0.0548 for the albedo of 0.999, the
/// greatest of the half-spaces. What a slab of depth 400 lacks in reflectance is of the order of
/// exp(−2 · 0.0548 · 400) = 1e-19, and what it transmits of exp(−0.0548 · 400) = 3e-10.
const ENDLESS: f64 = 400.0;

/// A row of the reference.
#[derive(Clone, Debug)]
struct Anchor {
    index: f64,
    albedo: f64,
    depth: f64,
    g: f64,
    /// R and T at normal, then at Lambertian incidence, as far as they are known.
    shares: [Option<f64>; 4],
}

fn anchors() -> Vec<Anchor> {
    let rows = REFERENCE
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>());
    let rows = rows.filter(|row| matches!(row[0], "slab" | "semi"));
    rows.map(|row| {
        let number = |text: &str| text.parse::<f64>().ok();
        Anchor {
            index: number(row[1]).expect("an index"),
            albedo: number(row[2]).expect("an albedo"),
            depth: number(row[3]).expect("a depth"),
            g: number(row[4]).unwrap_or(0.0),
            shares: [10, 11, 12, 13].map(|column: usize| number(row[column])),
        }
    })
    .collect()
}

/// A slab whose albedos differ by wavelength: light of all of them goes along the same paths.
fn scene(anchors: &[Anchor]) -> String {
    let depth = anchors[0].depth.min(ENDLESS);
    let table = |of: &dyn Fn(&Anchor) -> f64| {
        let mut rows: Vec<String> = (0_u16..)
            .zip(anchors)
            .map(|(i, anchor)| format!("[{}, {}]", 500 + 10 * i, of(anchor)))
            .collect();
        // A table has two rows at least.
        rows.push(format!("[2000, {}]", of(&anchors[0])));
        rows.join(", ")
    };
    let nm: Vec<String> = (0_u16..)
        .zip(anchors)
        .map(|(i, _)| (500 + 10 * i).to_string())
        .collect();
    format!(
        "[media.fill]\ng = {}\n\
         scattering_per_m = {{ table = [{}] }}\nabsorption_per_m = {{ table = [{}] }}\n\
         [materials.slab.dielectric]\neta = {}\ninterior = \"fill\"\n\
         [meshes.slab.box]\nsize_m = [{wide}, {wide}, {THICKNESS}]\n\
         [objects.slab]\nmesh = \"slab\"\nmaterial = \"slab\"\n\
         [instruments.field.canopy]\nwithin_m = [0, 0, {SIDE}, {SIDE}]\n\
         wavelengths_nm = [{}]\nincidence_deg = [0]\ndiffuse = true\n",
        anchors[0].g,
        table(&|anchor| anchor.albedo * depth / THICKNESS),
        table(&|anchor| (1.0 - anchor.albedo) * depth / THICKNESS),
        anchors[0].index,
        nm.join(", "),
        wide = 4.0 * SIDE,
    )
}

#[test]
#[ignore = "deep: 10 s; with LAMINA_ANCHORS=all ten minutes of a processor"]
fn slabs_and_half_spaces_of_media_are_those_of_the_table() {
    let anchors = anchors();
    assert_eq!(anchors.len(), 25);
    let is_whole = super::in_full();
    let (most, budget) = if is_whole {
        (
            5e-4,
            Budget {
                error: Some(renderer::instruments::Target::Absolute(4.9e-4)),
                ..rays(1 << 24)
            },
        )
    } else {
        (2.5e-3, rays(1 << 16))
    };
    let mut groups: Vec<Vec<Anchor>> = Vec::new();
    for anchor in anchors {
        let alike = |group: &&mut Vec<Anchor>| {
            let one = &group[0];
            (one.index, one.depth, one.g) == (anchor.index, anchor.depth, anchor.g)
        };
        match groups.iter_mut().find(alike) {
            Some(group) => group.push(anchor),
            None => groups.push(vec![anchor]),
        }
    }
    let (mut report, mut worst, mut greatest) = (String::new(), 0.0_f64, 0.0_f64);
    for group in groups {
        let found = figures(&scene(&group), &budget).expect("it can be measured");
        for (i, anchor) in (0_u16..).zip(&group) {
            let nm = f64::from(500 + 10 * i);
            let lights = [NORMAL, Direction::Diffuse];
            for (incidence, shares) in lights.into_iter().zip(anchor.shares.chunks(2)) {
                for (quantity, expected) in ["reflected", "transmitted"].into_iter().zip(shares) {
                    let Some(expected) = expected else { continue };
                    let row = of(&found, quantity, incidence, nm)
                        .next()
                        .expect("it is measured");
                    let z = (row.value - expected) / row.error;
                    let light = if incidence == NORMAL {
                        "normal"
                    } else {
                        "diffuse"
                    };
                    let Anchor {
                        index,
                        albedo,
                        depth,
                        g,
                        ..
                    } = anchor;
                    report += &format!(
                        "| {index} | {albedo} | {depth} | {g} | {light} {quantity} | {:.6} | \
                         {expected:.6} | {:.1e} | {z:+.2} |\n",
                        row.value, row.error
                    );
                    worst = worst.max(z.abs());
                    greatest = greatest.max(row.error);
                }
            }
        }
    }
    eprintln!("{report}");
    assert!(greatest <= most, "{greatest}\n{report}");
    assert!(worst < 4.0, "{worst}\n{report}");
}

#[test]
fn the_flux_of_a_medium_is_whole_and_what_it_absorbs_is_its_objects() {
    let anchor = Anchor {
        index: 1.33,
        albedo: 0.8,
        depth: 2.0,
        g: 0.5,
        shares: [None; 4],
    };
    for (index, depth) in [(1.0, 2.0), (1.33, 2.0), (1.33, 40.0)] {
        let others = [0.3, 0.8, 0.999].map(|albedo| Anchor {
            index,
            albedo,
            depth,
            ..anchor.clone()
        });
        let found = figures(&scene(&others), &rays(1 << 12)).expect("it can be measured");
        for incidence in [NORMAL, Direction::Diffuse] {
            for nm in [500.0, 510.0, 520.0] {
                let value = |word| of(&found, word, incidence, nm).next().map(|row| row.value);
                let [reflected, transmitted, absorbed] = ["reflected", "transmitted", "absorbed"]
                    .map(|word| value(word).expect("it is measured"));
                let sum = reflected + transmitted + absorbed;
                // At a boundary, what is lost within the rounding of single precision counts as nothing.
                assert!((sum - 1.0).abs() < 1e-6, "{index} {nm}: {sum}");
                assert!(absorbed > 0.0, "{index} {nm}: {absorbed}");
            }
        }
    }
}

#[test]
fn light_that_is_only_weakened_is_uncollided() {
    let clear = Anchor {
        index: 1.0,
        albedo: 0.0,
        depth: 1.5,
        g: 0.0,
        shares: [None; 4],
    };
    let scattering = Anchor {
        albedo: 0.6,
        ..clear.clone()
    };
    let found = figures(&scene(&[clear]), &rays(1 << 10)).expect("it can be measured");
    for quantity in ["transmitted", "uncollided"] {
        let row = of(&found, quantity, NORMAL, 500.0)
            .next()
            .expect("it is measured");
        assert!((row.value - f64::exp(-1.5)).abs() < 1e-6, "{row:?}");
    }
    let found = figures(&scene(&[scattering]), &rays(1 << 16)).expect("it can be measured");
    let row = of(&found, "uncollided", NORMAL, 500.0)
        .next()
        .expect("it is measured");
    assert!(
        (row.value - f64::exp(-1.5)).abs() < 4.0 * row.error,
        "{row:?}"
    );
}

#[test]
fn figures_of_media_have_the_same_bits_on_any_number_of_threads() {
    let anchors = [0.9, 0.99].map(|albedo| Anchor {
        index: 1.4,
        albedo,
        depth: 3.0,
        g: 0.8,
        shares: [None; 4],
    });
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let found = pool
            .expect("there are threads")
            .install(|| figures(&scene(&anchors), &rays(1 << 10)));
        found.expect("it can be measured")
    };
    let one = run(1);
    assert_eq!(one, run(2));
    assert_eq!(one, run(3));
}

#[test]
fn layers_of_a_canopy_do_not_resolve_what_a_medium_absorbs() {
    let anchor = Anchor {
        index: 1.0,
        albedo: 0.5,
        depth: 1.0,
        g: 0.0,
        shares: [None; 4],
    };
    let text = format!("{}layers_m = [0, 0.2]\n", scene(&[anchor]));
    let error = figures(&text, &rays(1 << 10)).expect_err("it is refused");
    assert!(matches!(error.problem, Problem::Inside { .. }), "{error}");
}
