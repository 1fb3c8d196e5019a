use glam::DVec2;

use super::testing::{GREYS, drawn};
use super::{Blade, FindingKind, Ink, Raster, Settings, Threshold, TraceError, Traced, trace};
use crate::leaf::Lamina;
use crate::leaf::venation_plan::VenationPlan;
use crate::measure::{Measures, measure};
use crate::species;
use crate::venation::network::VenationNetwork;

/// A preset of this length, mm, its finest veins as much finer as the leaf is smaller.
fn small(name: &str, length_mm: f64) -> (Lamina, f64) {
    let mut plan = species::find(name).expect("a preset").plan();
    let share = length_mm / plan.length_mm;
    plan.length_mm = length_mm;
    if let VenationPlan::Auxin(auxin) = &mut plan.venation {
        auxin.veinlet_radius_mm *= share;
    }
    let lamina = plan.grow_lamina().expect("a good plan");
    (lamina, plan.venation.murray_exponent())
}

/// Length-weighted mean radius, mm.
fn mean_radius(network: &VenationNetwork) -> f64 {
    let pieces = network.segments().map(|s| {
        let length = (s.to - s.from).length();
        (length, length * 0.5 * (s.radius_from + s.radius_to))
    });
    let (length, sum) = pieces.fold((0.0, 0.0), |(a, b), (c, d)| (a + c, b + d));
    sum / length
}

/// How many free endings a picture cannot show: those that jut out of the veins about them by less
/// than `radii` of their own radius, or touch one; and how many of them jut out so little of the
/// vein on which they stand that their junction is not seen either.
fn hidden_endings(network: &VenationNetwork, radii: f64) -> [usize; 2] {
    let edges = network.edges();
    let place = |node: u32| network.nodes()[node as usize].position;
    let mut into = vec![Vec::new(); network.nodes().len()];
    let mut degree = vec![0; network.nodes().len()];
    for (number, edge) in edges.iter().enumerate() {
        into[edge.to as usize].push(number);
        degree[edge.from as usize] += 1;
        degree[edge.to as usize] += 1;
    }
    let ends = (0..network.nodes().len() as u32)
        .filter(|&node| degree[node as usize] == 1 && into[node as usize].len() == 1);
    let (mut hidden, mut swallowed) = (0, 0);
    for node in ends {
        let mut own = Vec::new();
        let mut at = node;
        while let [edge] = into[at as usize][..]
            && degree[at as usize] <= 2
        {
            own.push(edge);
            at = edges[edge].from;
        }
        let (tip, radius) = (place(node), edges[own[0]].radius_to);
        let others = (0..edges.len()).filter(|number| !own.contains(number));
        // The way from the tip to the side of each other vein.
        let gaps = others.map(|number| {
            let edge = &edges[number];
            let (from, way) = (place(edge.from), place(edge.to) - place(edge.from));
            let along = ((tip - from).dot(way) / way.length_squared()).clamp(0.0, 1.0);
            let reach = edge.radius_from + along * (edge.radius_to - edge.radius_from);
            tip.distance(from + way * along) - reach
        });
        if gaps.fold(f64::INFINITY, f64::min) + radius < radii * radius {
            hidden += 1;
            let joined = edges.iter().filter(|edge| edge.from == at || edge.to == at);
            let reach = joined.fold(0.0, |most, edge| f64::max(most, edge.radius_to));
            let juts = tip.distance(place(at)) + radius - reach;
            swallowed += usize::from(juts < radii * radius);
        }
    }
    [hidden, swallowed]
}

/// Draws a leaf at a size of pixels and traces the drawing.
fn there_and_back(lamina: &Lamina, mm_per_pixel: f64) -> Traced {
    let picture = drawn(&lamina.outline, &lamina.network, mm_per_pixel);
    let settings = Settings {
        // Endings near the margin are told by the length of a piece, so it is the leaf's own.
        segment_mm: Some(lamina.network.segment_mm()),
        ..Settings::new(mm_per_pixel)
    };
    trace(&picture, &settings).expect("a leaf")
}

/// Fails with a table unless every measure is within 3 % of the leaf's own. A picture cannot show
/// endings that others hide; they are not missed.
fn agree(name: &str, lamina: &Lamina, exponent: f64, traced: &Traced) {
    let own = measure(&lamina.outline, &lamina.network, exponent);
    let found = measure(&traced.outline, &traced.network, exponent);
    let [hidden, swallowed] = hidden_endings(&lamina.network, 2.5).map(|count| count as f64);
    let number = |of: &Measures, key: &str| of.number(key).unwrap_or(0.0);
    let mut rows: Vec<(String, f64, f64)> = [
        "length_mm",
        "width_mm",
        "area_mm2",
        "perimeter_mm",
        "circularity",
        "solidity",
        "vein_length_mm",
        "vein_density_mm_per_mm2",
        "spanning_tree_ratio",
        "vein_distance_mm_mean",
        "vein_distance_mm_median",
        "areole_count",
        "areole_area_mm2_mean",
        "areole_area_mm2_median",
        "areole_circularity_median",
        "areole_elongation_median",
        "junction_degree_3_share",
    ]
    .into_iter()
    .map(|key| (key.to_owned(), number(&own, key), number(&found, key)))
    .collect();
    let free = "freely_ending_veinlet_count";
    rows.push((
        free.to_owned(),
        number(&own, free) - hidden,
        number(&found, free),
    ));
    let junctions = "junction_count";
    rows.push((
        junctions.to_owned(),
        number(&own, junctions) - swallowed,
        number(&found, junctions),
    ));
    let radii = [mean_radius(&lamina.network), mean_radius(&traced.network)];
    rows.push(("mean radius".to_owned(), radii[0], radii[1]));
    let mut table =
        format!("{name}: {hidden} endings hidden, {swallowed} of them with their junction\n");
    let mut is_good = true;
    for (key, own, found) in rows {
        let off = if own == found {
            0.0
        } else {
            100.0 * (found / own - 1.0)
        };
        is_good &= off.abs() <= 3.0 && off.is_finite();
        table += &format!("{key:38} {own:12.5} {found:12.5} {off:+7.2} %\n");
    }
    assert!(is_good, "{table}");
}

#[test]
fn a_drawing_of_a_small_leaf_gives_its_measures() {
    let (lamina, exponent) = small("runions-9c", 6.4);
    let traced = there_and_back(&lamina, 0.002);
    agree("runions-9c", &lamina, exponent, &traced);
}

#[test]
#[ignore = "deep: 200 megapixels"]
fn drawings_of_five_presets_at_2_um_per_pixel_give_their_measures() {
    for (name, length_mm) in [
        ("poplar", 14.0),
        ("brochidodromous", 14.0),
        ("free-endings", 17.0),
        ("reticulate", 16.0),
        ("alchemilla", 9.0),
    ] {
        let (lamina, exponent) = small(name, length_mm);
        let traced = there_and_back(&lamina, 0.002);
        agree(name, &lamina, exponent, &traced);
    }
}

/// One straight vein on a square blade, turned by an angle, with two radii in pixels at its ends.
fn line(degrees: f64, length: f64, radii: [f64; 2]) -> Raster {
    let (size, turn) = (700_usize, degrees.to_radians());
    let way = DVec2::new(libm::cos(turn), libm::sin(turn));
    let middle = DVec2::splat(350.0) + DVec2::new(0.31, 0.17);
    Raster::new(
        size,
        size,
        (0..size * size)
            .map(|at| {
                let p = DVec2::new((at % size) as f64 + 0.5, (at / size) as f64 + 0.5) - middle;
                let along = p.dot(way).clamp(-0.5 * length, 0.5 * length);
                let radius = radii[0] + (along / length + 0.5) * (radii[1] - radii[0]);
                if p.distance(way * along) <= radius {
                    GREYS[2]
                } else {
                    GREYS[1]
                }
            })
            .collect(),
    )
    .expect("a square")
}

/// The settings for a picture that is all blade, in pixels.
fn in_pixels() -> Settings {
    Settings {
        blade: Blade::Frame,
        ..Settings::new(1.0)
    }
}

#[test]
fn turned_lines_have_their_lengths_and_radii() {
    for degrees in [0.0, 7.0, 18.0, 26.6, 33.0, 45.0, 61.0, 77.5, 90.0, 118.0] {
        for radius in [1.25, 2.0, 3.4, 6.0, 12.3] {
            let picture = line(degrees, 500.0, [radius; 2]);
            let traced = trace(&picture, &in_pixels()).expect("a line");
            let length = traced.network.vein_length_mm();
            let mean = mean_radius(&traced.network);
            assert!(
                (length / 500.0 - 1.0).abs() < 0.01,
                "{degrees}° {radius}: {length}"
            );
            // Along rows or columns a line of two greys is a whole number of pixels wide. In very
            // fine lines the Gaussian thins the ink, so that the level lies farther out.
            let step = match (degrees % 90.0 == 0.0, radius < 2.0) {
                (true, true) => 0.35,
                (true, false) => 0.25,
                (false, true) => 0.2,
                (false, false) => 0.12,
            };
            let is_near = (mean - radius).abs() < step + 0.01 * radius;
            assert!(is_near, "{degrees}° {radius}: {mean}");
        }
    }
}

#[test]
fn a_taper_is_traced_as_a_taper() {
    let traced = trace(&line(30.0, 500.0, [12.0, 3.0]), &in_pixels()).expect("a line");
    for piece in traced.network.segments() {
        // The wide end is lower right in the picture or upper left; both are measured from there.
        let middle = 0.5 * (traced.frame.to_px(piece.from) + traced.frame.to_px(piece.to));
        let turn = 30.0_f64.to_radians();
        let way = DVec2::new(libm::cos(turn), libm::sin(turn));
        let along = (middle - DVec2::new(350.31, 350.17)).dot(way);
        let expected = 7.5 - 9.0 * along / 500.0;
        let radius = 0.5 * (piece.radius_from + piece.radius_to);
        assert!(
            (radius - expected).abs() < 0.35,
            "{along}: {radius}, not {expected}"
        );
    }
}

#[test]
fn noise_and_uneven_light_change_no_loop() {
    // A lattice of 6 × 6 meshes.
    let is_vein = |x: usize, y: usize| {
        let on = |v: usize| (50..=650).contains(&v) && (v + 3) % 100 >= 50 && (v + 3) % 100 < 57;
        (on(x) && (47..=654).contains(&y)) || (on(y) && (47..=654).contains(&x))
    };
    let mut state = 7_u64;
    let mut noise = || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 40) as f32 / (1 << 24) as f32 - 0.5
    };
    let values: Vec<f32> = (0..700 * 700)
        .map(|at| {
            let (x, y) = (at % 700, at / 700);
            let light = 1.0 - 0.0006 * (x + y) as f32;
            light * if is_vein(x, y) { 0.35 } else { 0.8 } + 0.2 * noise()
        })
        .collect();
    let picture = Raster::new(700, 700, values).expect("good");
    for threshold in [
        Threshold::Otsu { even_light: true },
        Threshold::Sauvola {
            window_px: 61.0,
            k: 0.2,
        },
    ] {
        let settings = Settings {
            threshold,
            smoothing_px: 1.0,
            ..in_pixels()
        };
        let traced = trace(&picture, &settings).expect("a lattice");
        assert_eq!(traced.network.loops(), 36, "{threshold:?}");
        let length = traced.network.vein_length_mm();
        assert!((length / 8400.0 - 1.0).abs() < 0.01, "{length}");
    }
}

#[test]
fn the_same_bits_come_from_one_thread_and_from_two() {
    let (lamina, _) = small("runions-9c", 6.4);
    let traced = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads")
            .install(|| there_and_back(&lamina, 0.004))
    };
    let (one, two) = (traced(1), traced(2));
    assert_eq!(one.network, two.network);
    assert_eq!(one.outline, two.outline);
}

#[test]
fn what_is_no_leaf_is_refused_with_its_reason() {
    let flat = |value: f32| Raster::new(64, 64, vec![value; 64 * 64]).expect("good");
    let refused = |picture: &Raster, settings: &Settings| {
        trace(picture, settings).expect_err("nothing to trace")
    };
    for value in [0.0, 0.5, 1.0] {
        let error = refused(&flat(value), &Settings::new(0.01));
        assert!(matches!(error, TraceError::NoLeaf(_)), "{error}");
        assert_eq!(refused(&flat(value), &in_pixels()), TraceError::NoContrast);
    }
    for scale in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = refused(&flat(0.5), &Settings::new(scale));
        assert!(matches!(error, TraceError::BadScale(_)), "{error}");
    }
    // A blade without veins.
    let square = |at: usize| (16..48).contains(&(at % 64)) && (16..48).contains(&(at / 64));
    let bare = (0..64 * 64).map(|at| if square(at) { 0.1 } else { 1.0 });
    let bare = Raster::new(64, 64, bare.collect()).expect("good");
    assert_eq!(refused(&bare, &Settings::new(1.0)), TraceError::NoContrast);
    let given = Settings {
        blade: Blade::Of(flat(0.1)),
        ..Settings::new(1.0)
    };
    let other = Raster::new(32, 64, vec![0.5; 32 * 64]).expect("good");
    assert!(matches!(
        refused(&other, &given),
        TraceError::OtherSize { .. }
    ));
    let off = Settings {
        base_px: Some(DVec2::new(70.0, 3.0)),
        ..in_pixels()
    };
    assert!(matches!(
        refused(&flat(0.5), &off),
        TraceError::OffPicture { end: "base", .. }
    ));
    let level = Settings {
        threshold: Threshold::Level(0.2),
        ..in_pixels()
    };
    assert!(matches!(
        refused(&flat(0.5), &level),
        TraceError::NoVeins(_)
    ));
    let bright = Settings {
        veins: Ink::Bright,
        spur_radii: -1.0,
        ..in_pixels()
    };
    assert!(matches!(
        refused(&flat(0.5), &bright),
        TraceError::BadSetting { .. }
    ));
    assert!(Raster::new(2, 9, vec![0.0; 18]).is_err());
    assert!(Raster::new(4, 4, vec![f32::NAN; 16]).is_err());
    assert!(Raster::new(usize::MAX, 2, Vec::new()).is_err());
}

#[test]
fn a_petiole_is_taken_off_and_its_foot_is_the_base() {
    // A round blade with a midrib, on a stalk that leaves it downwards.
    let value = |x: f64, y: f64| {
        let is_vein = (x - 200.0).abs() <= 5.0 && (60.0..380.0).contains(&y);
        let is_blade = DVec2::new(x - 200.0, y - 160.0).length() <= 120.0;
        GREYS[if is_vein { 2 } else { usize::from(is_blade) }]
    };
    let values = (0..400 * 400).map(|at| value((at % 400) as f64 + 0.5, (at / 400) as f64 + 0.5));
    let picture = Raster::new(400, 400, values.collect()).expect("good");
    let traced = trace(&picture, &Settings::new(0.1)).expect("a leaf");
    let found = |finding: &super::Finding| finding.kind == FindingKind::Petiole;
    assert!(traced.findings.iter().any(found));
    assert!(traced.frame.base_px.distance(DVec2::new(200.0, 280.0)) < 8.0);
    assert!(
        (traced.outline.length() - 24.0).abs() < 0.5,
        "{}",
        traced.outline.length()
    );
    assert!((traced.outline.area() / (std::f64::consts::PI * 144.0) - 1.0).abs() < 0.01);
}

#[test]
fn lines_one_pixel_wide_are_traced_in_any_direction() {
    // A stalk with two diagonal arms.
    let is_line = |x: usize, y: usize| {
        let arm = (11..=49).contains(&y) && x.abs_diff(60) == 49 - y;
        arm || (x == 60 && (10..110).contains(&y))
    };
    for (veins, ink) in [(Ink::Bright, [0.0, 1.0]), (Ink::Dark, [1.0, 0.0])] {
        let values = (0..120 * 120).map(|at| ink[usize::from(is_line(at % 120, at / 120))]);
        let picture = Raster::new(120, 120, values.collect()).expect("a mask");
        let settings = Settings {
            blade: Blade::Frame,
            veins,
            threshold: Threshold::Level(0.5),
            ..Settings::new(0.01)
        };
        let traced = trace(&picture, &settings).expect("lines");
        let measures = measure(&traced.outline, &traced.network, 3.0);
        assert_eq!(measures.number("junction_count"), Some(1.0));
        let (length, expected) = (
            traced.network.vein_length_mm(),
            0.99 + 0.76 * 2.0_f64.sqrt(),
        );
        assert!(
            (length - expected).abs() < 0.02,
            "{length} mm is not {expected}"
        );
    }
}

#[test]
fn a_wide_midrib_is_followed_from_the_base_to_its_tip() {
    use crate::shape::outline::Outline;
    use crate::venation::network::{VeinEdge, VeinNode};

    // An ellipse, 7 by 10 mm, a midrib that tapers, and secondaries on both sides in turn; the first is
    // nearer to the base than two radii of the midrib.
    let margin = (0..200).map(|i| {
        let turn = std::f64::consts::TAU * f64::from(i) / 200.0;
        DVec2::new(3.5 * libm::sin(turn), 5.0 - 5.0 * libm::cos(turn))
    });
    let outline = Outline::new(margin.collect(), DVec2::ZERO, DVec2::new(0.0, 10.0));
    let outline = outline.expect("an ellipse");
    let mut places = vec![DVec2::ZERO];
    let mut edges = Vec::new();
    let radius = |y: f64| 0.16 - 0.013 * y;
    let mut edge = |from: usize, to: usize, [radius_from, radius_to]: [f64; 2], order: u8| {
        edges.push(VeinEdge {
            from: from as u32,
            to: to as u32,
            radius_from,
            radius_to,
            order,
        });
    };
    let (mut at, mut y) = (0, 0.0);
    for number in 0..12_u32 {
        let next = 0.3 + 0.8 * f64::from(number);
        places.push(DVec2::new(0.0, next));
        let node = places.len() - 1;
        edge(at, node, [radius(y), radius(next)], 1);
        (at, y) = (node, next);
        if number < 10 {
            let side = if number % 2 == 0 { 1.0 } else { -1.0 };
            let length = 0.6 * (9.5 - next).min(3.0 + next);
            places.push(DVec2::new(0.8 * side * length, next + 0.6 * length));
            let wide = 0.45 * radius(next);
            edge(node, places.len() - 1, [wide, 0.6 * wide], 2);
        }
    }
    let length = y;
    let nodes = places
        .into_iter()
        .map(|position| VeinNode { position, born: 0 });
    let network = VenationNetwork::from_parts(nodes.collect(), edges, 0.05).expect("a network");
    let mm_per_pixel = 0.01;
    let picture = drawn(&outline, &network, mm_per_pixel);
    let (low, high) = outline.bounds();
    let base_px = DVec2::new(-low.x, high.y) / mm_per_pixel + 12.0;
    let settings = Settings {
        base_px: Some(base_px),
        ..Settings::new(mm_per_pixel)
    };
    let traced = trace(&picture, &settings).expect("a leaf");
    let measures = measure(&traced.outline, &traced.network, 3.0);
    let found = measures.number("midrib_length_mm").expect("a midrib");
    // Where the stub below the first secondary was, the line still bends by a few pixels.
    assert!(
        (found / length - 1.0).abs() < 0.02,
        "{found} mm is not {length}"
    );
    assert!(
        !traced
            .findings
            .iter()
            .any(|f| matches!(f.kind, FindingKind::Moved { .. }))
    );
    // Without a base the same place is found, and reported as a guess.
    let guessed = trace(&picture, &Settings::new(mm_per_pixel)).expect("a leaf");
    let off = guessed.frame.base_px.distance(base_px);
    let wide = 2.0 * radius(0.0) / mm_per_pixel;
    assert!(off < wide, "{off} pixels from the base");
    let said: Vec<String> = guessed.findings.iter().map(ToString::to_string).collect();
    assert!(
        said.iter().any(|said| said.contains("--base X,Y")),
        "{said:?}"
    );
    // A base that is given beside the leaf is moved to it, and that is reported.
    let beside = Settings {
        base_px: Some(base_px - DVec2::new(300.0, 0.0)),
        ..settings
    };
    let traced = trace(&picture, &beside).expect("a leaf");
    let moved = traced
        .findings
        .iter()
        .find_map(|finding| match finding.kind {
            FindingKind::Moved {
                end,
                by_mm,
                is_outside,
            } => Some((end, by_mm, is_outside)),
            FindingKind::Specks { .. }
            | FindingKind::Holes { .. }
            | FindingKind::Spurs { .. }
            | FindingKind::Crossings { .. }
            | FindingKind::Thin { .. }
            | FindingKind::Petiole
            | FindingKind::BaseGuessed { .. }
            | FindingKind::Apart { .. } => None,
        });
    let (end, by_mm, is_outside) = moved.expect("it is reported");
    assert_eq!((end, is_outside), ("base", true));
    assert!(by_mm > 1.0, "{by_mm} mm");
}
