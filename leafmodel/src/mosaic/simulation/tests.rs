mod steered;

use glam::DVec3;

use super::*;
use crate::grow_options::GrowOptions;
use crate::mosaic::control::{ControlImage, CylinderControl, Steered};
use crate::mosaic::growth::SurfaceGrowth;
use crate::mosaic::plan::CellType;
use crate::mosaic::testing::{sphere, square};

fn small(cells: usize, days: f64) -> MosaicPlan {
    MosaicPlan {
        initial_cells: cells,
        days,
        ..MosaicPlan::default()
    }
}

/// Expected cells at each relaxation event from one, each type for itself, for an even number of
/// events a day:
/// `M(k) = P(T > k) + 2 Σ P(T = j) M(k − j)`.
fn branching(mean_days: f64, per_day: usize, events: usize) -> f64 {
    // P(T = j): a Poisson number of days and any time of that day, rounded to events.
    let mut shares = vec![0.0; events + 2 * per_day + 2];
    let mut of_day = libm::exp(-mean_days);
    for day in 0..=events / per_day + 1 {
        if day > 0 {
            of_day *= mean_days / day as f64;
        }
        for part in 0..per_day {
            // Half of the part rounds down, half up.
            for end in [part, part + 1] {
                let event = (day * per_day + end) as f64 - 0.5 * per_day as f64;
                shares[event.max(1.0) as usize] += 0.5 * of_day / per_day as f64;
            }
        }
    }
    let poisson = shares;
    let mut cells = vec![1.0];
    for k in 1..=events {
        let alive = 1.0 - poisson[1..=k].iter().sum::<f64>();
        let born: f64 = (1..=k).map(|j| 2.0 * poisson[j] * cells[k - j]).sum();
        cells.push(alive + born);
    }
    cells[events]
}

#[test]
fn cells_multiply_as_the_branching_process_says() {
    let surface = square(50.0, 5.0);
    let plan = MosaicPlan {
        types: MosaicPlan::two_types([5.0, 10.0], [0.5, 0.8], 0.5, 0.0),
        step: 0.0,
        initial_relaxations: 0,
        ..small(1500, 18.0)
    };
    let days = [0.0, 4.0, 6.0, 11.0, 18.0];
    let stages = GrowOptions::default()
        .mosaics(&surface, &plan, 3, &days)
        .expect("good");
    for (stage, day) in stages.iter().zip(days) {
        for (kind, mean) in [(0, 5.0), (1, 10.0)] {
            let of_kind = |mosaic: &Mosaic| {
                mosaic.cells.iter().filter(|cell| cell.kind == kind).count() as f64
            };
            let expected = of_kind(&stages[0]) * branching(mean, 4, (day * 4.0) as usize);
            // About 750 founders whose progeny spread by some 30 %: a standard error near 1 %.
            let ratio = of_kind(stage) / expected;
            assert!(
                (ratio - 1.0).abs() < 0.04,
                "type {kind} on day {day}: {ratio}"
            );
        }
    }
}

#[test]
fn no_cell_leaves_the_surface_and_clones_descend_from_their_founders() {
    let surface = square(20.0, 3.0);
    let mosaic = Mosaic::grow(&surface, &small(300, 22.0), 1).expect("good");
    assert!(mosaic.cells.len() > 1000);
    for (number, cell) in mosaic.cells.iter().enumerate() {
        assert!((cell.at.face as usize) < surface.faces().len());
        let [u, v, w] = cell.at.barycentric;
        assert!(u.min(v).min(w) >= -1e-12 && (u + v + w - 1.0).abs() < 1e-12);
        match cell.parent {
            None => assert_eq!(cell.clone as usize, number),
            Some(parent) => assert_eq!(mosaic.cells[parent as usize].clone, cell.clone),
        }
    }
}

fn least_spacing(places: &[DVec3]) -> f64 {
    let mut least = f64::INFINITY;
    for (i, a) in places.iter().enumerate() {
        for b in &places[..i] {
            least = least.min(a.distance(*b));
        }
    }
    least
}

#[test]
fn relaxation_lowers_the_energy_and_spreads_the_cells() {
    let surface = sphere(10.0, 1.0);
    let plan = MosaicPlan {
        initial_relaxations: 0,
        ..small(500, 0.0)
    };
    let mut run = Run::start(&surface, &plan, 1, &|| false).expect("good");
    let free = vec![vec![0.0; 2]; 2];
    let energy = |run: &Run<'_>| run.relaxation.energy(&run.mature, &run.cells, &free);
    let radius = run.relaxation.radius();
    let mut last = energy(&run);
    let first = last;
    for event in 0..300 {
        run.relax(&free, 0.066);
        let now = energy(&run);
        assert!(now <= last * 1.002, "event {event}: {last} → {now}");
        last = now;
    }
    assert!(last < 0.1 * first, "{first} → {last}");
    let places = run.mosaic(0.0).expect("good").positions();
    let least = least_spacing(&places) / radius;
    assert!(least >= 0.7, "least spacing {least} r");
}

#[test]
fn crowded_cells_come_to_rest_too() {
    let surface = square(10.0, 2.0);
    let plan = MosaicPlan {
        initial_relaxations: 0,
        radius_weight: 6.0,
        ..small(800, 0.0)
    };
    let mut run = Run::start(&surface, &plan, 1, &|| false).expect("good");
    let free = vec![vec![0.0; 2]; 2];
    let energy = |run: &Run<'_>| run.relaxation.energy(&run.mature, &run.cells, &free);
    let mut last = energy(&run);
    for event in 0..60 {
        run.relax(&free, 1.0);
        let now = energy(&run);
        assert!(now <= last * 1.001, "event {event}: {last} → {now}");
        last = now;
    }
}

#[test]
fn two_sheets_close_in_space_do_not_act_on_one_another() {
    let sheet = square(10.0, 1.0);
    // The sheet, and a copy a hundredth of a millimetre above: one surface of two parts.
    let count = sheet.positions().len() as u32;
    let above = sheet.positions().iter().map(|at| *at + DVec3::Z * 0.01);
    let positions = sheet.positions().iter().copied().chain(above).collect();
    let lifted = sheet.faces().iter().map(|face| face.map(|id| id + count));
    let faces = sheet.faces().iter().copied().chain(lifted).collect();
    let double = Surface::new(positions, faces).expect("good");
    let plan = small(400, 0.0);
    let mut run = Run::start(&double, &plan, 1, &|| false).expect("good");
    let free = vec![vec![0.0; 2]; 2];
    let lower = |run: &Run<'_>| -> Vec<(usize, DVec3)> {
        let mosaic = run.mosaic(0.0).expect("good");
        let cells = mosaic.cells.iter().zip(mosaic.positions()).enumerate();
        let lower = cells.filter(|(_, (_, at))| at.z < 0.005);
        lower.map(|(number, (_, at))| (number, at)).collect()
    };
    // The same with the upper cells taken away. (The weight of a step is far from where crowding
    // lowers it.)
    let alone: Vec<usize> = lower(&run).iter().map(|(number, _)| *number).collect();
    assert!(alone.len() > 100 && alone.len() < 300);
    let before = run.cells.clone();
    run.relax(&free, 0.066);
    let together = lower(&run);
    run.cells = alone.iter().map(|&number| before[number]).collect();
    run.relax(&free, 0.066);
    for ((_, with), (_, without)) in together.iter().zip(lower(&run)) {
        assert_eq!(*with, without);
    }
}

#[test]
fn clones_stay_together() {
    let surface = square(30.0, 3.0);
    let plan = MosaicPlan {
        types: MosaicPlan::two_types([8.0, 8.0], [0.5, 0.8], 0.5, 0.0),
        ..small(150, 24.0)
    };
    let mosaic = Mosaic::grow(&surface, &plan, 4).expect("good");
    let places = mosaic.positions();
    let count = places.len();
    let (mut same, mut by_chance) = (0, 0);
    for i in 0..count {
        let distance = |j: &usize| places[*j].distance_squared(places[i]);
        let nearest = (0..count)
            .filter(|&j| j != i)
            .min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let nearest = nearest.expect("there are others");
        same += u32::from(mosaic.cells[i].clone == mosaic.cells[nearest].clone);
        // Shuffled: the clone of another cell far down the list.
        let other = (nearest * 7919 + 13) % count;
        by_chance += u32::from(mosaic.cells[i].clone == mosaic.cells[other].clone);
    }
    let (same, by_chance) = (
        f64::from(same) / count as f64,
        f64::from(by_chance) / count as f64,
    );
    assert!(same > 0.5 && by_chance < 0.05, "{same} against {by_chance}");
}

#[test]
fn any_number_of_types_grow_side_by_side() {
    let types = 5;
    let row = |hot: usize, on: f64, off: f64| {
        (0..types)
            .map(|i| if i == hot { on } else { off })
            .collect::<Vec<_>>()
    };
    let plan = MosaicPlan {
        types: (0..types)
            .map(|kind| CellType {
                name: format!("type {kind}"),
                division_days: 6.0 + kind as f64,
                initial_probability: 0.2,
                switching: row(kind, 0.92, 0.02),
                adhesion: row(kind, 0.5, 0.0),
            })
            .collect(),
        ..small(500, 15.0)
    };
    let mosaic = Mosaic::grow(&sphere(10.0, 2.0), &plan, 8).expect("good");
    let count = |kind| mosaic.cells.iter().filter(|cell| cell.kind == kind).count();
    let counts: Vec<usize> = (0..types as u16).map(count).collect();
    assert!(counts.iter().all(|&count| count > 100), "{counts:?}");
    // The cells that divide fastest are the most numerous.
    assert!(counts[0] > counts[4], "{counts:?}");
    let switched = mosaic.cells.iter().filter(|cell| {
        cell.parent
            .is_some_and(|parent| mosaic.cells[parent as usize].kind != cell.kind)
    });
    let children = mosaic.cells.len() - 500;
    let share = switched.count() as f64 / children as f64;
    assert!((share - 0.08).abs() < 0.025, "{share} switched");
}

#[test]
fn the_bits_do_not_depend_on_threads_or_on_the_days_asked_for() {
    let surface = sphere(10.0, 2.0);
    let plan = small(300, 12.0);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads")
            .install(|| Mosaic::grow(&surface, &plan, 9).expect("good"))
    };
    let (one, two) = (with(1), with(2));
    assert_eq!(one.cells, two.cells);
    let stages = GrowOptions::default()
        .mosaics(&surface, &plan, 9, &[12.0, 3.0])
        .expect("good");
    assert_eq!(stages[0].cells, one.cells);
    assert!(stages[1].cells.len() < one.cells.len() && stages[1].day == 3.0);
    let other = Mosaic::grow(&surface, &plan, 10).expect("good");
    assert_ne!(other.cells, one.cells);
    let stopped = GrowOptions::stopped_by(&|| true).mosaics(&surface, &plan, 9, &[12.0]);
    assert_eq!(stopped.expect_err("stopped").to_string(), "stopped");
}

#[test]
fn on_a_growing_surface_cells_keep_their_spacing() {
    let surface = square(20.0, 2.0);
    let plan = MosaicPlan {
        growth: Some(SurfaceGrowth {
            start: DVec3::new(0.5, 0.25, 1.0),
            middle: Some(0.5),
            steepness: Some(6.0),
            days: None,
        }),
        // Enough events for the young to move apart before the next are born.
        relaxations_per_day: 20,
        types: MosaicPlan::two_types([10.0, 10.0], [0.2, 0.2], 0.1, 0.0),
        ..small(200, 20.0)
    };
    let days = [0.0, 10.0, 20.0];
    let stages = GrowOptions::default()
        .mosaics(&surface, &plan, 6, &days)
        .expect("good");
    for stage in &stages {
        // The area per cell stays constant, since divisions fill the room made by growth.
        let cell_area = stage.surface.total_area() / stage.cells.len() as f64;
        assert!(
            (cell_area / (50.0 / 200.0) - 1.0).abs() < 0.08,
            "day {}: {cell_area} mm²",
            stage.day
        );
        assert_eq!(stage.radius_mm, 0.5);
        // Mean distance to the nearest.
        let places = stage.positions();
        let nearest = |i: usize| {
            let others = (0..places.len()).filter(|&j| j != i);
            others
                .map(|j| places[i].distance(places[j]))
                .fold(f64::INFINITY, f64::min)
        };
        let mean = (0..places.len()).map(nearest).sum::<f64>() / places.len() as f64;
        // Of cells at random it would be 0.25 mm; in the densest packing, 0.54 mm.
        let first = if stage.day == 0.0 { 0.3 } else { 0.36 };
        assert!(mean > first, "day {}: {mean} mm", stage.day);
    }
    assert!((stages[2].surface.total_area() - 400.0).abs() < 1e-9);
    assert!(stages[2].cells.len() > 7 * stages[0].cells.len());
}

#[test]
fn a_daily_radius_follows_the_cells() {
    let plan = MosaicPlan {
        radius: RadiusRule::Daily,
        ..small(200, 20.0)
    };
    let mosaic = Mosaic::grow(&sphere(10.0, 2.0), &plan, 1).expect("good");
    let expected = (mosaic.surface.total_area() / mosaic.cells.len() as f64).sqrt();
    assert!((mosaic.radius_mm / expected - 1.0).abs() < 0.02);
}

#[test]
fn what_a_plan_has_wrong_is_named() {
    let types = || MosaicPlan::two_types([5.0, 10.0], [0.5, 0.8], 0.1, 0.0);
    let refused = |change: &dyn Fn(&mut Vec<CellType>)| {
        let mut types = types();
        change(&mut types);
        let plan = MosaicPlan {
            types,
            ..MosaicPlan::default()
        };
        plan.validate().expect_err("wrong").to_string()
    };
    assert_eq!(
        refused(&|types| types[0].initial_probability = 0.5),
        "the initial probabilities of the types sum to 1.4, not to 1"
    );
    assert_eq!(
        refused(&|types| types[1].switching = vec![0.25, 0.5]),
        "the switching probabilities of type \"background\" sum to 0.75, not to 1"
    );
    assert_eq!(
        refused(&|types| types[0].division_days = -1.0),
        "division_days of type \"foreground\" is -1, outside the positive numbers"
    );
    assert_eq!(
        refused(&|types| types[0].adhesion[1] = 0.5),
        "adhesion of \"foreground\" to \"background\" is 0.5, of \"background\" to \"foreground\" 0; the two have to be equal"
    );
    assert_eq!(
        refused(&|types| types[0].adhesion.push(0.5)),
        "adhesion of type \"foreground\" has 3 numbers; there are 2 types"
    );
    assert_eq!(
        refused(&|types| types.clear()),
        "there are 0 cell types; a mosaic has 1 to 1000"
    );
    let explosive = MosaicPlan {
        types: MosaicPlan::two_types([0.1, 0.1], [0.5, 0.8], 0.1, 0.0),
        initial_relaxations: 0,
        step: 0.0,
        radius_weight: 10.0,
        ..small(200, 1000.0)
    };
    let error = explosive.validate().expect_err("bound to fail");
    assert_eq!(
        error.to_string(),
        "cells of type \"foreground\" divide every 0.1 days: after 1000 days there would be more than 4000000; make the days fewer \
         or the divisions rarer"
    );
    // If a control sets division rates, too many cells are found only during growth.
    let explosive = MosaicPlan {
        controls: vec![CylinderControl {
            from: DVec3::ZERO,
            to: DVec3::Z,
            radius_mm: None,
            image: ControlImage::Constant(1.0),
            steers: Steered::DivisionRate {
                kind: None,
                low: 0.0,
                high: 1.0,
            },
        }],
        ..explosive
    };
    let surface = square(10.0, 5.0);
    let options = GrowOptions {
        most_cells: 5000,
        ..GrowOptions::default()
    };
    let error = options.mosaics(&surface, &explosive, 1, &[1000.0]);
    let error = error.expect_err("too many").to_string();
    assert!(error.contains("more than 5000 cells"), "{error}");
}

#[test]
fn the_first_days_of_a_growing_surface_are_those_of_the_whole_course() {
    let surface = square(20.0, 2.0);
    let plan = |days: f64| MosaicPlan {
        growth: Some(SurfaceGrowth {
            start: DVec3::new(0.5, 0.5, 1.0),
            days: Some(20.0),
            ..SurfaceGrowth::default()
        }),
        ..small(200, days)
    };
    let course = GrowOptions::default().mosaics(&surface, &plan(20.0), 6, &[8.0]);
    let day_8 = &course.expect("good")[0];
    let young = Mosaic::grow(&surface, &plan(8.0), 6).expect("good");
    assert_eq!(young.cells, day_8.cells);
    let fraction = young.surface.total_area() / surface.total_area();
    assert!((fraction / (0.7 * 0.7) - 1.0).abs() < 1e-12, "{fraction}");
}
