//! Mesh and map together have the slopes of the height field, and no slope twice.

use glam::DVec2;

use super::super::{Bulge, HeldSheet, SurfaceMap, SurfaceOf, SurfacePlan};
use crate::blade::frame::UvFrame;
use crate::blade::mesh::{BladeMesh, Displacement};
use crate::blade::tests::{ellipse, flat};
use crate::blade::tissue::tests::GREEN;
use crate::blade::{BladeForm, MarginThickness};
use crate::shape::outline::Outline;
use crate::venation::conformal_map::ConformalMap;
use crate::venation::network::VeinSegment;

/// A net of square areoles of 1.2 mm, with a thicker midrib.
fn net() -> Vec<VeinSegment> {
    let line = |i: i32, along: bool, radius: f64| {
        let at = 1.2 * f64::from(i);
        let [from, to] = [-1.0, 17.0].map(|end| {
            if along {
                DVec2::new(at, end)
            } else {
                DVec2::new(end - 8.0, at)
            }
        });
        VeinSegment {
            from,
            to,
            radius_from: radius,
            radius_to: radius,
            order: if radius > 0.1 { 1 } else { 4 },
        }
    };
    let fine = (-7..8).filter(|i| *i != 0).map(|i| line(i, true, 0.03));
    let across = (0..14).map(|i| line(i, false, 0.03));
    fine.chain(across).chain([line(0, true, 0.25)]).collect()
}

/// Fine veins, which no mesh has, are level with the adaxial face, so that its slopes are the bulge's.
const PLAN: SurfacePlan = SurfacePlan {
    impressed: 0.0,
    raised: 0.4,
    bulge_mm: 0.2,
    bulge_width_mm: 0.6,
    ..SurfacePlan::SMOOTH
};

fn blade(max_edge_mm: f64) -> (Outline, BladeMesh, UvFrame) {
    let form = BladeForm {
        relief: 0.1,
        margin: MarginThickness::EVEN,
        meshed_vein_radius_mm: 0.2,
        max_edge_mm,
        ..flat()
    };
    let (outline, veins) = (ellipse(8.0, 14.0, 160), net());
    let frame = UvFrame::around(outline.points());
    let sheet = HeldSheet {
        frame: &frame,
        veins: &veins,
        full_vein_radius_mm: GREEN.full_vein_radius_mm,
    };
    let bulge = Bulge::of(&PLAN, &sheet, 0.75 * max_edge_mm);
    let displaced = Displacement {
        bulge: &|p| bulge.height(p),
        ..Displacement::NONE
    };
    let flat = ConformalMap::FLAT;
    let mesh = BladeMesh::from_veins_displaced(&outline, &veins, flat, &form, displaced);
    (outline, mesh.expect("a blade"), frame)
}

fn map(mesh: Option<&BladeMesh>, outline: &Outline, frame: &UvFrame, size: [u32; 2]) -> SurfaceMap {
    let veins = net();
    let blade = SurfaceOf {
        frame,
        margin: outline.points(),
        veins: &veins,
        tissue: &GREEN,
        mesh,
        withering: None,
        seed: 1,
    };
    SurfaceMap::of(&PLAN, &blade, size).expect("a good plan")
}

/// The slope of the shading normal of a blade in space, which is not bent, at a flat point.
fn shaded_slope(mesh: &BladeMesh, p: DVec2) -> Option<DVec2> {
    mesh.triangles.iter().find_map(|triangle| {
        let [a, b, c] = triangle.map(|v| mesh.lamina[v as usize]);
        let doubled = (b - a).perp_dot(c - a);
        let weights = [
            (c - b).perp_dot(p - b) / doubled,
            (a - c).perp_dot(p - c) / doubled,
            (b - a).perp_dot(p - a) / doubled,
        ];
        weights.iter().all(|w| *w >= 0.0).then(|| {
            let normal: glam::DVec3 = (0..3)
                .map(|i| mesh.normals[triangle[i] as usize] * weights[i])
                .sum();
            -normal.truncate() / normal.z
        })
    })
}

/// Mean squares over places inside, away from the midrib, which every mesh has: of the slopes of the whole field, of those that the map of a
/// blade with a mesh has, and of what mesh and map together differ by from the field.
fn mean_squares(max_edge_mm: f64) -> [f64; 3] {
    let (outline, mesh, frame) = blade(max_edge_mm);
    let size = [240, 420];
    let whole = map(None, &outline, &frame, size);
    let rest = map(Some(&mesh), &outline, &frame, size);
    let texel = frame.size / DVec2::new(240.0, 420.0);
    let mut sums = [0.0; 3];
    for number in 0..1500_u32 {
        let column = (number * 97) % 240;
        let row = (number * 181) % 420;
        let p = frame.min + texel * (DVec2::new(f64::from(column), f64::from(row)) + 0.5);
        if p.x.abs() < 0.8 || !outline.contains(p) || outline.distance_to_margin(p) < 0.2 {
            continue;
        }
        let texel = (row * 240 + column) as usize;
        let slope = |map: &SurfaceMap| {
            let [x, y, ..] = map.texels[texel][0];
            DVec2::new(f64::from(x), f64::from(y))
        };
        let meshed = shaded_slope(&mesh, p).expect("the mesh covers the blade");
        let (whole, rest) = (slope(&whole), slope(&rest));
        sums[0] += whole.length_squared();
        sums[1] += rest.length_squared();
        sums[2] += (meshed + rest - whole).length_squared();
    }
    sums
}

#[test]
fn a_coarse_mesh_leaves_the_relief_to_the_map() {
    let [whole, rest, error] = mean_squares(4.0);
    assert!((rest / whole - 1.0).abs() < 0.12, "{rest} of {whole}");
    // The shading normal changes within a texel; there is nothing else to differ by.
    assert!(error < 0.003 * whole, "{error} of {whole}");
}

#[test]
fn a_fine_mesh_carries_the_bulge_and_the_map_has_the_rest() {
    let [whole, rest, error] = mean_squares(0.12);
    assert!(rest < 0.2 * whole, "{rest} of {whole}");
    assert!(error < 0.003 * whole, "{error} of {whole}");
    let [_, middle, _] = mean_squares(0.5);
    assert!(rest < middle && middle < whole, "{rest} {middle} {whole}");
}

#[test]
fn a_displaced_mesh_is_as_high_as_its_areoles() {
    let (_, mesh, _) = blade(0.12);
    let highest = mesh.positions.iter().map(|p| p.z).fold(f64::MIN, f64::max);
    let bulges = mesh.relief_mm.iter().map(|relief| relief[1]);
    let most = bulges.fold(0.0, f64::max);
    assert!((highest - most).abs() < 1e-9, "{highest} {most}");
    // An areole of 1.2 mm, of two widths, rises to part of the 0.2 mm.
    assert!((0.04..0.2).contains(&most), "{most}");
}
