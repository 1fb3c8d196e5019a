use glam::DVec3;

use crate::mosaic::paint::sheet::SheetField;

use super::*;
use crate::mosaic::control::{ControlImage, Steered};
use crate::mosaic::shapes::sphere;
use crate::mosaic::voronoi::tests::{scattered, surface};
use crate::optics::{Constituent, Contents};

fn kinds(sites: usize, types: u16) -> Vec<u16> {
    (0..sites).map(|i| (i * 7 % 11) as u16 % types).collect()
}

/// A square sheet of side 10 mm.
fn square() -> Surface {
    let corners = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)];
    let coarse = Surface::new(
        corners.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec(),
        vec![[0, 1, 2], [0, 2, 3]],
    )
    .expect("a sheet");
    coarse.subdivided(1.0).expect("a good length").0
}

fn contents(chlorophyll: f64) -> Contents {
    Contents::new(1.5, chlorophyll, 8.0, 0.0, 0.0, 0.01, 0.005).expect("in range")
}

#[test]
fn weights_add_up_to_one_and_hard_edges_show_the_nearest_cell() {
    let ball = surface(sphere(20.0, 2.0).expect("good sizes"));
    let sites = scattered(&ball, 500, 1);
    let kinds = kinds(500, 3);
    let soft = TypeField::new(&ball, &sites, &kinds, 3, 0.8);
    let hard = TypeField::new(&ball, &sites, &kinds, 3, 0.0);
    let mut weights = [0.0; 3];
    let mut mixed = 0;
    for probe in scattered(&ball, 3000, 2) {
        soft.type_weights(&probe, &mut weights);
        assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        assert!(weights.iter().all(|&w| (0.0..=1.0).contains(&w)));
        mixed += usize::from(weights.iter().all(|&w| w < 1.0));
        let own = usize::from(soft.kind(&probe));
        assert!(
            weights.iter().all(|&w| w <= weights[own] + 1e-9),
            "the own type is strongest"
        );
        hard.type_weights(&probe, &mut weights);
        assert_eq!(weights[own], 1.0);
    }
    assert!(mixed > 300 && mixed < 2700, "{mixed} places lie in a blend");
}

#[test]
fn the_blend_is_half_and_half_on_the_edge_and_done_at_its_width() {
    let sheet = square();
    let field = TypeField::new(
        &sheet,
        &[
            at(&sheet, DVec2::new(3.0, 5.0)),
            at(&sheet, DVec2::new(7.0, 5.0)),
        ],
        &[0, 1],
        2,
        1.0,
    );
    let mut weights = [0.0; 2];
    for (x, expected) in [
        (4.4, 1.0),
        (4.75, 0.84375),
        (5.0, 0.5),
        (5.25, 0.15625),
        (5.6, 0.0),
    ] {
        field.type_weights(&at(&sheet, DVec2::new(x, 3.3)), &mut weights);
        assert!((weights[0] - expected).abs() < 1e-9, "{x}: {weights:?}");
    }
}

/// The point of a flat sheet at a place, by looking at all faces.
fn at(sheet: &Surface, p: DVec2) -> SurfacePoint {
    let one = SurfacePoint {
        face: 0,
        barycentric: [1.0, 0.0, 0.0],
    };
    let field = TypeField::new(sheet, &[one], &[0], 1, 0.0);
    SheetField::new(sheet, field, false).locate(p)
}

#[test]
fn weights_are_continuous_over_faces_of_a_flat_sheet() {
    let sheet = square();
    let sites = scattered(&sheet, 60, 4);
    let kinds = kinds(60, 3);
    let field = TypeField::new(&sheet, &sites, &kinds, 3, 0.5);
    let field = SheetField::new(&sheet, field, false);
    let (mut last, mut now) = ([0.0; 3], [0.0; 3]);
    for line in 0..5 {
        for step in 0..20_000 {
            let p = DVec2::new(5e-4 * f64::from(step), 0.17 + 2.0 * f64::from(line));
            field.field().type_weights(&field.locate(p), &mut now);
            if step > 0 {
                for (a, b) in last.iter().zip(&now) {
                    // The smooth step's slope is at most 3/2 over the width of 0.5 mm; sums of
                    // three divide by at least ½, which makes each weight at most six times as
                    // steep.
                    assert!((a - b).abs() < 5e-4 * 3.0 * 6.0, "{p}: {last:?} {now:?}");
                }
            }
            last = now;
        }
    }
}

#[test]
fn beyond_the_margin_the_nearest_point_of_the_sheet_counts() {
    let sheet = square();
    for (outside, nearest) in [
        ((-0.7, 4.2), (0.0, 4.2)),
        ((10.6, 10.9), (10.0, 10.0)),
        ((3.3, 3.4), (3.3, 3.4)),
    ] {
        let found = sheet.position(&at(&sheet, DVec2::from(outside)));
        assert!(
            found.truncate().distance(DVec2::from(nearest)) < 1e-9,
            "{found}"
        );
    }
}

#[test]
fn the_two_faces_of_a_blade_hold_half_of_its_contents_each() {
    let sheet = square();
    let both = Surface::both_faces(&sheet).expect("a small sheet");
    let adaxial = at(&sheet, DVec2::new(5.0, 5.0));
    let [u, v, w] = adaxial.barycentric;
    let abaxial = SurfacePoint {
        face: adaxial.face + sheet.faces().len() as u32,
        barycentric: [u, w, v],
    };
    let field = TypeField::new(&both, &[adaxial, abaxial], &[0, 1], 2, 0.1);
    let field = SheetField::new(&both, field, true);
    let found = field.at(
        DVec2::new(4.0, 6.0),
        &[contents(60.0), contents(10.0)],
        &mut [0.0; 2],
    );
    assert!((found[Constituent::Chlorophyll] - 35.0).abs() < 1e-9);
    assert!(
        (found[Constituent::Water] - 0.01).abs() < 1e-12
            && (found[Constituent::Structure] - 1.5).abs() < 1e-12
    );
}

#[test]
fn where_no_cell_may_be_the_tissue_is_not_of_the_mosaic() {
    let sheet = square();
    let left = CylinderControl {
        from: DVec3::X * -1.0,
        to: DVec3::X * 4.0,
        radius_mm: None,
        image: ControlImage::Constant(1.0),
        steers: Steered::Blocked,
    };
    let cells = [at(&sheet, DVec2::new(8.0, 5.0))];
    let field = TypeField::new(&sheet, &cells, &[0], 1, 0.1);
    let field = field.heeding(Arc::new(sheet.clone()), &[left]);
    let points = [(3.9, 5.0), (4.1, 5.0), (0.1, 9.9)].map(|p| Some(at(&sheet, DVec2::from(p))));
    let painted = field.paint(points.into_par_iter(), &[contents(40.0)]);
    assert_eq!(painted, [None, Some(contents(40.0)), None]);
}

#[test]
fn borders_are_searched_only_where_types_meet_and_no_farther_than_the_nearest_of_each() {
    let sheet = square();
    let sites = scattered(&sheet, 200, 4);
    let field = |kinds: &[u16], blend_mm: f64, most: u64| {
        let voronoi = Voronoi::new(&sheet, &sites);
        TypeField::limited(&sheet, voronoi, kinds, 3, blend_mm, most)
    };
    // Cells of one type have no borders: nothing is laid out, however wide the blend.
    assert!(field(&[1; 200], 100.0, 0).is_some());
    let kinds = kinds(200, 3);
    assert!(field(&kinds, 100.0, 1000).is_none(), "there is a limit");
    // All borders within reach give the same weights as those that are kept.
    let near = field(&kinds, 100.0, u64::MAX).expect("no limit");
    let mut all = near.clone();
    let everywhere: Vec<Border> = (0..sheet.faces().len() as u32)
        .flat_map(|face| {
            // The sheet is flat, but every face has a frame of its own.
            let own = borders_in(&near.voronoi, &kinds, face);
            own.into_iter().map(move |border| (face, border))
        })
        .map(|(face, border)| {
            let place = |at: DVec2| sheet.position(&sheet.point(face, at)).truncate();
            let (from, to) = (place(border.from), place(border.to));
            Border { from, to, ..border }
        })
        .collect();
    for (face, borders) in (0_u32..).zip(&mut all.borders) {
        let [a, b, _] = sheet.corners(face);
        let centre = sheet.position(&sheet.centre(face)).truncate();
        let [x, y] = [a, b].map(|corner| sheet.position(&sheet.point(face, corner)).truncate());
        // From the sheet into the frame of the face: a turn and a shift.
        let back = |by: DVec2, at: DVec2| DVec2::new(by.x, -by.y).rotate(at);
        let turn = back((b - a).normalize(), (y - x).normalize());
        let into = |at: DVec2| back(turn, at - x) + a;
        assert!(into(centre).distance(sheet.flat(&sheet.centre(face))) < 1e-9);
        *borders = everywhere
            .iter()
            .map(|border| Border {
                from: into(border.from),
                to: into(border.to),
                kinds: border.kinds,
            })
            .collect();
    }
    let (mut few, mut many) = ([0.0; 3], [0.0; 3]);
    for probe in scattered(&sheet, 500, 5) {
        near.type_weights(&probe, &mut few);
        all.type_weights(&probe, &mut many);
        for (a, b) in few.iter().zip(many) {
            assert!((a - b).abs() < 1e-9, "{few:?} {many:?}");
        }
    }
    let kept: usize = near.borders.iter().map(Vec::len).sum();
    assert!(
        kept * 4 < everywhere.len() * near.borders.len(),
        "{kept} are kept"
    );
}
