//! Figs. 1, 5 to 9: leaves of a croton.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use super::super::statistics::{
    PatternClass, contained, contiguity, element_count, kappa, mean_width_mm, neighbourhood,
    patches,
};
use super::{BACKGROUND, FOREGROUND, Row, Seen, grown, surface};
use crate::blade::mottle::Mottle;
use crate::grow_options::GrowOptions;
use crate::mosaic::paint::TypeField;
use crate::mosaic::paint::sheet::SheetField;
use crate::mosaic::shapes::sheet;
use crate::mosaic::testing::noise_labels;
use crate::mosaic::{Mosaic, Surface, SurfacePoint};
use crate::species;

/// Figs. 5 and 7.
const AGEING: Row = Row {
    cells: 10_000,
    days: 30.0,
    radius_weight: 1.0,
    adhesion: [0.5, 0.8],
    division: [5.0, 10.0],
    foreground: 0.1,
    switching: 0.0,
};

/// Fig. 9.
const INDIVIDUALS: Row = Row {
    cells: 2000,
    division: [10.0, 10.0],
    foreground: 0.12,
    switching: 0.03,
    ..AGEING
};

/// The lamina of the croton preset.
fn lamina(max_edge: f64) -> Surface {
    let croton = species::find("croton").expect("a preset").plan();
    let outline = croton.outline.grow(croton.length_mm, croton.seed);
    surface(sheet(&outline.expect("a good outline"), max_edge).expect("a good length"))
}

/// Mean distance from the first foreground of places that turn from background to foreground, over
/// that of all background places. 1 if distance does not matter.
fn nearness_of_the_turned(places: &[DVec3], first: &[u32], later: &[u32]) -> f64 {
    let of = |label: u32| {
        let with = places.iter().zip(first).zip(later);
        with.filter(move |((_, first), _)| **first == label)
    };
    let old: Vec<DVec3> = of(FOREGROUND).map(|((&place, _), _)| place).collect();
    let (mut turned, mut all) = (Vec::new(), Vec::new());
    for ((place, _), later) in of(BACKGROUND) {
        let to = old.iter().map(|old| old.distance_squared(*place));
        let nearest = to.fold(f64::INFINITY, f64::min).sqrt();
        all.push(nearest);
        if *later == FOREGROUND {
            turned.push(nearest);
        }
    }
    let mean = |list: &[f64]| list.iter().sum::<f64>() / list.len() as f64;
    mean(&turned) / mean(&all)
}

/// Distance of what turns yellow from what was yellow, over that of any place: noise has at least
/// this.
const NOISE_BELOW: f64 = 0.93;
/// What a mosaic has at most.
const MOSAIC_ABOVE: f64 = 0.8;

#[test]
#[ignore = "deep: 10 s"]
fn a_croton_yellows_by_the_borders_of_its_blotches_and_noise_does_not() {
    let leaf = lamina(1.0);
    let days = [5.0, 15.0, 20.0, 30.0];
    let stages = GrowOptions::default().mosaics(&leaf, &AGEING.plan(), 1, &days);
    let stages: Vec<Seen> = stages.expect("a good plan").iter().map(Seen::of).collect();
    let shares: Vec<f64> = stages.iter().map(Seen::share).collect();
    assert!(shares[0] < 0.15 && shares[3] > 0.5, "{shares:?}");
    // Four probes to a square millimetre would be finer than blotches; 8000 on 4900 mm² lie some
    // 0.8 mm apart.
    let points = leaf.probes(8000, 1);
    let places: Vec<DVec3> = points.iter().map(|point| leaf.position(point)).collect();
    let marked: Vec<Vec<u32>> = stages.iter().map(|one| one.at(&leaf, &points)).collect();
    for two in marked.windows(2) {
        let kept = contained(&two[0], &two[1], FOREGROUND);
        assert!(kept > 0.95, "{kept} of the old blotches");
        let near = nearness_of_the_turned(&places, &two[0], &two[1]);
        // Far nearer than noise ever is, below.
        assert!(near < MOSAIC_ABOVE, "what turns yellow is as far as {near}");
    }
    // Noise with the same shares, at rising scale, as in Fig. 6.
    for seed in 1..4 {
        let noise: Vec<Vec<u32>> = shares
            .iter()
            .zip([2.0, 4.0, 6.0, 8.0])
            .map(|(&share, scale_mm)| noise_labels(scale_mm, share, &places, seed))
            .collect();
        for (two, share) in noise.windows(2).zip(&shares[1..]) {
            // With noise, the older foreground is kept only by chance, so the share kept is that of
            // the newer pattern.
            let kept = contained(&two[0], &two[1], FOREGROUND);
            assert!((kept - share).abs() < 0.1, "{kept} against {share}");
            let near = nearness_of_the_turned(&places, &two[0], &two[1]);
            assert!(
                (NOISE_BELOW..2.0 - NOISE_BELOW).contains(&near),
                "noise: {near}"
            );
        }
    }
}

#[test]
#[ignore = "deep: 6 s"]
fn clones_of_the_ageing_croton_are_contiguous() {
    let last = grown(&lamina(1.0), &AGEING.plan(), 1);
    assert!(contiguity(&last.voronoi, &last.clones) > 0.98);
    // A clone's greatest patch holds most of its cells.
    let mut sizes: BTreeMap<u32, (usize, usize)> = BTreeMap::new();
    for patch in patches(&last.voronoi, &last.clones) {
        let (all, most) = sizes.entry(patch.label).or_default();
        *all += patch.cells;
        *most = (*most).max(patch.cells);
    }
    let sum = |part: fn(&(usize, usize)) -> usize| sizes.values().map(part).sum::<usize>() as f64;
    let whole = sum(|size| size.1) / sum(|size| size.0);
    assert!(whole > 0.93, "{whole} of the cells are with their clone");
    let alike = neighbourhood(&last.voronoi, &last.kinds, 5, 1);
    assert!(alike.alike > alike.by_chance + 10.0 * alike.deviation);
}

#[test]
fn three_crotons_differ_with_equal_statistics_and_are_unstructured() {
    let leaf = lamina(2.0);
    let points = leaf.probes(8000, 1);
    let plan = INDIVIDUALS.plan();
    let mosaics: Vec<Mosaic> = (1..4)
        .map(|seed| Mosaic::grow(&leaf, &plan, seed).expect("a good plan"))
        .collect();
    let leaves: Vec<Seen> = mosaics.iter().map(Seen::of).collect();
    let marked: Vec<Vec<u32>> = leaves.iter().map(|one| one.at(&leaf, &points)).collect();
    let of = |measure: &dyn Fn(&Seen) -> f64| leaves.iter().map(measure).collect::<Vec<f64>>();
    let shares = of(&Seen::share);
    let widths = of(&|one| mean_width_mm(&one.voronoi, &one.kinds, FOREGROUND));
    let blotches = of(&|one| {
        let all = patches(&one.voronoi, &one.kinds);
        all.iter().filter(|patch| patch.label == FOREGROUND).count() as f64
    });
    for (a, b) in [(0, 1), (1, 2), (0, 2)] {
        // The standard error of κ of 8000 probes of blotches of a few square millimetres is about
        // 0.03.
        let alike = kappa(&marked[a], &marked[b]);
        assert!(alike.abs() < 0.1, "{alike}");
        assert!((shares[a] - shares[b]).abs() < 0.03, "{shares:?}");
        assert!((widths[a] / widths[b] - 1.0).abs() < 0.12, "{widths:?}");
        assert!(
            (blotches[a] / blotches[b] - 1.0).abs() < 0.2,
            "{blotches:?}"
        );
    }
    // Blotches are counted across the leaf at five heights: their number differs between
    // individuals.
    let mut counts = Vec::new();
    for (mosaic, seen) in mosaics.iter().zip(&leaves) {
        let field = SheetField::new(
            &leaf,
            TypeField::of_mosaic(mosaic, 2, 0.0).expect("hard edges"),
            false,
        );
        for height in [40.0, 60.0, 75.0, 90.0, 110.0] {
            let across = (0..200).map(|i| DVec2::new(-15.0 + 0.15 * f64::from(i), height));
            let across: Vec<SurfacePoint> = across.map(|p| field.locate(p)).collect();
            counts.push(element_count(&seen.at(&leaf, &across), FOREGROUND, 3));
        }
    }
    assert_eq!(
        PatternClass::of_counts(&counts),
        PatternClass::Unstructured,
        "{counts:?}"
    );
}

#[test]
fn noise_of_a_small_lattice_repeats_its_blotches_and_a_mosaic_does_not() {
    const SCALE_MM: f64 = 4.0;
    const REPEAT_CELLS: u32 = 6;
    let leaf = lamina(2.0);
    let mosaic = Mosaic::grow(&leaf, &INDIVIDUALS.plan(), 1).expect("a good plan");
    let seen = Seen::of(&mosaic);
    let field = SheetField::new(
        &leaf,
        TypeField::of_mosaic(&mosaic, 2, 0.0).expect("hard edges"),
        false,
    );
    // A square of the lamina, and how far along the midrib it is compared with itself.
    let square = |shift: f64| {
        let places = (0..1600).map(|i| (f64::from(i % 40), f64::from(i / 40)));
        let moved = places.map(|(x, y)| DVec2::new(0.75 * x - 15.0, 0.75 * y + 35.0 + shift));
        moved.collect::<Vec<DVec2>>()
    };
    let of_mosaic = |shift: f64| {
        let points: Vec<SurfacePoint> = square(shift).iter().map(|&p| field.locate(p)).collect();
        seen.at(&leaf, &points)
    };
    let noise = Mottle::new(1, SCALE_MM).repeating(REPEAT_CELLS);
    let of_noise = |shift: f64| -> Vec<u32> {
        let marked = |p: &DVec2| u32::from(noise.at(*p) > 0.25);
        square(shift).iter().map(marked).collect()
    };
    let period = SCALE_MM * f64::from(REPEAT_CELLS);
    assert!(kappa(&of_noise(0.0), &of_noise(period)) > 0.999);
    let first = of_mosaic(0.0);
    let alike = (12..=45).map(|mm| kappa(&first, &of_mosaic(f64::from(mm))));
    let most = alike.fold(f64::NEG_INFINITY, f64::max);
    assert!(most < 0.2, "κ {most} at some distance");
}
