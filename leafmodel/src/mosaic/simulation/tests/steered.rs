//! Mosaics with controls.

use glam::DVec3;

use super::small;
use crate::mosaic::control::{ControlImage, CylinderControl, Steered};
use crate::mosaic::testing::{sphere, square};
use crate::mosaic::voronoi::Voronoi;
use crate::mosaic::{Mosaic, MosaicPlan, SurfacePoint};

#[test]
fn no_cell_is_created_in_or_enters_a_blocked_area() {
    let surface = sphere(10.0, 2.0);
    let plan = MosaicPlan {
        controls: vec![CylinderControl {
            from: DVec3::Z * -11.0,
            to: DVec3::ZERO,
            radius_mm: None,
            image: ControlImage::Constant(1.0),
            steers: Steered::Blocked,
        }],
        ..small(400, 24.0)
    };
    let mosaic = Mosaic::grow(&surface, &plan, 5).expect("good");
    assert!(mosaic.cells.len() > 1500);
    assert!(mosaic.positions().iter().all(|at| at.z > -1e-9));
    let nowhere = CylinderControl {
        to: DVec3::Z * 11.0,
        ..plan.controls[0].clone()
    };
    let plan = MosaicPlan {
        controls: vec![nowhere],
        ..plan
    };
    let refused = Mosaic::grow(&surface, &plan, 5).expect_err("no room");
    assert!(refused.to_string().contains("1000 throws"), "{refused}");
}

#[test]
fn an_image_decides_initial_types_and_rates() {
    let surface = sphere(10.0, 2.0);
    let stripes = |steers| CylinderControl {
        from: DVec3::Z * -11.0,
        to: DVec3::Z * 11.0,
        radius_mm: None,
        image: ControlImage::Stripes {
            count: 4,
            share: 0.5,
            waviness: 0.0,
            bends: 0.0,
            seed: 0,
        },
        steers,
    };
    let white = |at: DVec3| stripes(Steered::Blocked).value(at) == Some(1.0);
    let plan = MosaicPlan {
        controls: vec![
            stripes(Steered::InitialType(0)),
            stripes(Steered::DivisionRate {
                kind: None,
                low: 0.0,
                high: 1.0,
            }),
        ],
        initial_relaxations: 0,
        step: 0.0,
        ..small(500, 15.0)
    };
    let mosaic = Mosaic::grow(&surface, &plan, 2).expect("good");
    let places = mosaic.positions();
    let same = mosaic
        .cells
        .iter()
        .zip(&places)
        .filter(|(cell, at)| (cell.kind == 0) == white(**at));
    assert!(same.count() as f64 > 0.99 * mosaic.cells.len() as f64);
    // In black nothing divides; half of the sphere is white.
    let black = mosaic.cells.iter().filter(|cell| cell.kind == 1);
    assert!(black.clone().all(|cell| cell.parent.is_none()));
    assert!((200..300).contains(&black.count()));
}

#[test]
fn an_image_decides_where_children_are_of_another_type() {
    let surface = square(20.0, 1.5);
    let half = |value: f64, low: f64, high: f64| CylinderControl {
        from: DVec3::X * -1.0,
        to: DVec3::X * 10.0,
        radius_mm: None,
        image: ControlImage::Constant(value),
        steers: Steered::Switching {
            pair: [1, 0],
            low,
            high,
        },
    };
    // A quarter of the children of type 1 are of type 0, to the left none or all.
    for (control, expected) in [(half(0.0, 0.0, 2.0), 0.0), (half(1.0, 0.0, 1000.0), 1.0)] {
        let mut plan = MosaicPlan {
            controls: vec![control],
            types: MosaicPlan::two_types([1e6, 10.0], [0.5, 0.5], 0.0, 0.25),
            ..small(600, 15.0)
        };
        // Where all children are of type 0 none is of type 1, so that parents do not move far.
        plan.radius_weight = 0.5;
        let mosaic = Mosaic::grow(&surface, &plan, 3).expect("good");
        let places = mosaic.positions();
        let children = mosaic.cells.iter().zip(&places);
        let children: Vec<_> = children.filter(|(cell, _)| cell.parent.is_some()).collect();
        let share = |left: bool| {
            let there = children
                .iter()
                .filter(|(_, at)| (at.x < 9.5) == left && (at.x - 10.0).abs() > 0.5);
            let kinds: Vec<bool> = there.map(|(cell, _)| cell.kind == 0).collect();
            kinds.iter().filter(|&&other| other).count() as f64 / kinds.len() as f64
        };
        assert!((share(true) - expected).abs() < 0.02, "{}", share(true));
        assert!((0.15..0.4).contains(&share(false)), "{}", share(false));
    }
}

#[test]
fn an_image_decides_how_far_cells_adhere() {
    let surface = square(20.0, 1.5);
    let plan = MosaicPlan {
        controls: vec![CylinderControl {
            from: DVec3::X * -1.0,
            to: DVec3::X * 10.0,
            radius_mm: None,
            image: ControlImage::Constant(1.0),
            steers: Steered::Adhesion {
                pair: [0, 0],
                low: 1.0,
                high: 0.0,
            },
        }],
        types: MosaicPlan::two_types([10.0, 10.0], [0.9, 0.9], 0.5, 0.0),
        ..small(600, 20.0)
    };
    let mosaic = Mosaic::grow(&surface, &plan, 3).expect("good");
    let sites: Vec<SurfacePoint> = mosaic.cells.iter().map(|cell| cell.at).collect();
    let areas = Voronoi::new(&surface, &sites);
    let places = mosaic.positions();
    let mean_area = |left: bool| {
        let cells = mosaic.cells.iter().zip(&places).zip(areas.areas());
        let chosen = cells.filter(|((cell, at), _)| cell.kind == 0 && (at.x < 10.0) == left);
        let (sum, count) = chosen.fold((0.0, 0.0), |(sum, count), (_, area)| {
            (sum + area, count + 1.0)
        });
        sum / count
    };
    // To the left cells of type 0 repel one another in full, to the right hardly: there they are
    // crowded together.
    let ratio = mean_area(true) / mean_area(false);
    assert!(ratio > 1.3, "{ratio}");
}
