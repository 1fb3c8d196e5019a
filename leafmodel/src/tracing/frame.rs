//! From pixels to the frame of a leaf: base, apex, millimetres.

use glam::DVec2;

use crate::tracing::Frame;

use super::assembly::{Vein, Veins, network, parts};
use super::error::TraceError;
use super::findings::{Finding, FindingKind};
use super::grid::Mask;
use super::lines::{BOUND, Lines};
use super::margin::{boundary, simplified};
use super::settings::{Blade, Settings};
use super::traced::Traced;
use crate::plane::{polygon, polyline, segment};
use crate::shape::outline::{Outline, OutlineError};

/// A vein reaches the margin if it comes nearer than this many of its radii.
const AT_MARGIN: f64 = 1.5;

/// A vein ends at the margin if its middle line, prolonged by so many of its radii, reaches it.
const AT_END: f64 = 3.0;

/// Greatest share of the nodes of veins that may lie outside the margin.
const MOST_OUTSIDE: f64 = 0.5;

/// So many points at the end of a vein tell its radius there.
const END_POINTS: usize = 8;

/// Radius of a midrib at the base, as a share of the widest vein's greatest, at least.
const LEAST_BASE: f64 = 0.4;

/// Veins begin at the node that is nearest to the base when each is nearer by so many of the radii
/// of its veins: a midrib that ends some pixels before the margin, and not a fine vein beside it.
const NEARER_BY: f64 = 6.0;

/// How far a base or an apex that is given may be from the margin without a word, as a fraction of
/// the blade's extent.
const FAR_OFF: f64 = 0.02;

/// So many of the widest points of veins are looked at for the one that reaches the margin.
const MOST_WIDE: usize = 10_000;

/// Places margin and veins in the frame of the leaf. `joint` is the cell of the blade at which the
/// petiole was.
pub(super) fn in_millimetres(
    lines: &Lines,
    blade: &Mask,
    joint: Option<usize>,
    settings: &Settings,
    mut findings: Vec<Finding>,
) -> Result<Traced, TraceError> {
    let line = boundary(blade);
    let margin = match settings.blade {
        Blade::Frame => corners(blade),
        Blade::Silhouette | Blade::Of(_) => simplified(&line, BOUND),
    };
    let wanted = settings.base_px.or_else(|| {
        let place_px = blade.centre(joint?);
        findings.push(Finding::at(place_px, FindingKind::Petiole));
        Some(place_px)
    });
    let wanted = wanted.unwrap_or_else(|| {
        // A piece that is cut out has no base of its own.
        let (place_px, by) = if settings.blade == Blade::Frame {
            let middle = DVec2::new(0.5 * (blade.stride - 2) as f64, (blade.rows - 2) as f64);
            (middle, "the middle of the picture's lower side")
        } else {
            let place = widest_at_margin(&lines.veins, &margin);
            (place, "where the widest vein meets the margin")
        };
        findings.push(Finding::at(place_px, FindingKind::BaseGuessed { by }));
        place_px
    });
    let base = polygon::nearest(&margin, wanted).at;
    let extent = extent(&margin);
    for (end, given) in [("base", settings.base_px), ("apex", settings.apex_px)] {
        let Some(given) = given else { continue };
        let off = polygon::nearest(&margin, given).at.distance(given);
        if off > FAR_OFF * extent {
            let moved = FindingKind::Moved {
                end,
                by_mm: off * settings.mm_per_pixel,
                is_outside: !blade.cells[blade.cell_at(given)],
            };
            findings.push(Finding::at(given, moved));
        }
    }
    let apex = match (settings.apex_px, &settings.blade) {
        (Some(apex), _) => polygon::nearest(&margin, apex).at,
        (None, Blade::Frame) => polygon::nearest(&margin, DVec2::new(base.x, 0.0)).at,
        (None, Blade::Silhouette | Blade::Of(_)) => farthest(&margin, base),
    };
    let frame = Frame {
        base_px: base,
        axis: (apex - base).normalize_or(-DVec2::Y),
        mm_per_pixel: settings.mm_per_pixel,
    };
    let outline = outline(
        &line,
        &margin,
        &frame,
        apex,
        matches!(settings.blade, Blade::Frame),
    )?;
    let outside = lines.veins.nodes.iter();
    let outside = outside.filter(|node| !outline.contains(frame.to_mm(**node)));
    let share = outside.count() as f64 / lines.veins.nodes.len().max(1) as f64;
    if share > MOST_OUTSIDE {
        return Err(TraceError::VeinsOutside(share));
    }
    let mut veins = lines.veins.clone();
    part_at_base(&mut veins, base);
    let mut roots = roots(&veins, &frame, &mut findings);
    join_base(&mut veins, &mut roots[0], base, lines.segment_px);
    let segment_mm = lines.segment_px * settings.mm_per_pixel;
    let network = network(&veins, &roots, &frame, segment_mm)?;
    Ok(Traced {
        outline,
        network,
        findings,
        frame,
    })
}

/// The corners of the picture.
fn corners(blade: &Mask) -> Vec<DVec2> {
    let (width, height) = ((blade.stride - 2) as f64, (blade.rows - 2) as f64);
    let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)];
    corners.map(DVec2::from).to_vec()
}

/// The margin as an outline. Where the smooth line crosses itself (between two teeth a pixel
/// apart), the line around the pixels themselves is taken, which never does.
fn outline(
    line: &[DVec2],
    margin: &[DVec2],
    frame: &Frame,
    apex: DVec2,
    is_frame: bool,
) -> Result<Outline, TraceError> {
    let of = |points: &[DVec2]| {
        // The ends of the midrib lie on the line that is smooth; rounding may leave them off it.
        let points = points.iter().map(|&p| frame.to_mm(p)).collect();
        Outline::new(points, DVec2::ZERO, frame.to_mm(apex))
    };
    match of(margin) {
        Err(OutlineError::SelfCrossing { .. }) if !is_frame => {
            let mut line = line.to_vec();
            // Base and apex become points of it.
            for end in [frame.base_px, apex] {
                let nearest = polyline::nearest(&line, end);
                if let Some(place) = line.get_mut(nearest) {
                    *place = end;
                }
            }
            Ok(of(&line)?)
        }
        result => Ok(result?),
    }
}

/// The longer side of a line's bounds.
fn extent(line: &[DVec2]) -> f64 {
    let low = line.iter().copied().reduce(DVec2::min).unwrap_or_default();
    let high = line.iter().copied().reduce(DVec2::max).unwrap_or_default();
    (high - low).max_element()
}

/// The point of a line that is farthest from a place.
fn farthest(line: &[DVec2], place: DVec2) -> DVec2 {
    let off = |p: &DVec2| p.distance_squared(place);
    let far = line
        .iter()
        .copied()
        .max_by(|p, q| off(p).total_cmp(&off(q)));
    far.unwrap_or(place)
}

/// Where the widest vein that reaches the margin does so, prolonged to the margin; the widest place
/// of all if none does.
///
/// A midrib ends at the base. Where no end of a vein reaches the margin, a place in the middle of
/// one is taken, as where a picture is cut.
fn widest_at_margin(veins: &Veins, margin: &[DVec2]) -> DVec2 {
    if let Some(place) = widest_end_at_margin(veins, margin) {
        return place;
    }
    let points = veins.list.iter().enumerate().flat_map(|(number, vein)| {
        let radii = vein.radii.iter().enumerate();
        radii.map(move |(i, radius)| (*radius, number, i))
    });
    let mut points: Vec<(f64, usize, usize)> = points.collect();
    // The sort is stable, so that of equals the first is taken.
    points.sort_by(|a, b| b.0.total_cmp(&a.0));
    let widest = points.first().map_or(0.0, |point| point.0);
    let reaches = |(radius, number, i): &&(f64, usize, usize)| {
        let place = veins.list[*number].points[*i];
        polygon::nearest(margin, place).at.distance(place) <= AT_MARGIN * radius + 2.0
    };
    let wide = points.iter().take(MOST_WIDE);
    let found = wide
        .take_while(|(radius, ..)| *radius >= LEAST_BASE * widest)
        .find(reaches);
    let Some(&(radius, number, i)) = found.or(points.first()) else {
        return DVec2::ZERO;
    };
    let way = &veins.list[number].points;
    let (start, inwards): (usize, Vec<DVec2>) = if 2 * i < way.len() {
        (0, way.clone())
    } else {
        (way.len() - 1, way.iter().rev().copied().collect())
    };
    let end = way[start];
    let inner = inwards.iter().find(|p| p.distance(end) >= 3.0 * radius);
    let inner = inner.or(inwards.last()).copied().unwrap_or(end);
    let ahead = (end - inner).normalize_or_zero();
    crossing(margin, end, ahead)
        .filter(|place| place.distance(end) <= 3.0 * radius + 4.0)
        .unwrap_or(way[i])
}

/// The mean radius over some points at an end of a vein, 0 for the first: the very end is rounded.
fn radius_at_end(vein: &Vein, side: usize) -> f64 {
    let few = vein.radii.len().min(END_POINTS);
    let radii = if side == 0 {
        &vein.radii[..few]
    } else {
        &vein.radii[vein.radii.len() - few..]
    };
    radii.iter().sum::<f64>() / few as f64
}

/// Where the widest of the veins that end at the margin meets it.
fn widest_end_at_margin(veins: &Veins, margin: &[DVec2]) -> Option<DVec2> {
    let mut degrees = vec![0_u32; veins.nodes.len()];
    for end in veins.list.iter().flat_map(|vein| vein.ends) {
        degrees[end as usize] += 1;
    }
    let mut best: Option<(f64, DVec2)> = None;
    for vein in &veins.list {
        for (side, _) in (0..2)
            .zip(vein.ends)
            .filter(|(_, end)| degrees[*end as usize] == 1)
        {
            let inwards = |i: usize| {
                if side == 0 {
                    i
                } else {
                    vein.points.len() - 1 - i
                }
            };
            let radius = radius_at_end(vein, side);
            if best.is_some_and(|(widest, _)| widest >= radius) {
                continue;
            }
            let end = vein.points[inwards(0)];
            let mut behind = (0..vein.points.len()).map(|i| vein.points[inwards(i)]);
            let inner = behind.rfind(|p| p.distance(end) <= 4.0 * radius);
            let ahead = (end - inner.unwrap_or(end)).normalize_or_zero();
            let reach = AT_END * radius + 4.0;
            let met = crossing(margin, end, ahead).filter(|place| place.distance(end) <= reach);
            best = met.map(|place| (radius, place)).or(best);
        }
    }
    // One that is fine beside the widest veins is a tip at the margin, no base.
    let widest = veins.list.iter().flat_map(|vein| &vein.radii);
    let widest = widest.copied().fold(0.0, f64::max);
    best.filter(|(radius, _)| *radius >= LEAST_BASE * widest)
        .map(|(_, place)| place)
}

/// Where a ray meets a closed line first.
fn crossing(line: &[DVec2], start: DVec2, way: DVec2) -> Option<DVec2> {
    let meetings = polygon::sides(line).filter_map(|(a, b)| {
        let (far, share) = segment::meeting(start, way, a, b);
        (far >= 0.0 && (0.0..=1.0).contains(&share)).then_some(far)
    });
    let far = meetings.fold(f64::INFINITY, f64::min);
    far.is_finite().then(|| start + way * far)
}

/// Makes a node of the place of a vein that is nearest to the base, if it is clearly nearer than all
/// nodes: between the base and the first lateral a wide midrib may be so short that it was cut off as
/// a spur, and the rest of it leads into the lateral.
fn part_at_base(veins: &mut Veins, base: DVec2) {
    let mut nearest: Option<(f64, usize, usize)> = None;
    for (number, vein) in veins.list.iter().enumerate() {
        for (i, (point, radius)) in vein.points.iter().zip(&vein.radii).enumerate() {
            let key = point.distance(base) - NEARER_BY * radius;
            if nearest.is_none_or(|(least, ..)| key < least) {
                nearest = Some((key, number, i));
            }
        }
    }
    let Some((_, number, i)) = nearest else {
        return;
    };
    let vein = &veins.list[number];
    let (place, radius) = (vein.points[i], vein.radii[i]);
    let to_node = veins.nodes.iter().map(|node| node.distance(base));
    let to_node = to_node.fold(f64::INFINITY, f64::min);
    let is_within = i > 0 && i + 1 < vein.points.len();
    if !is_within || place.distance(base) > to_node - radius {
        return;
    }
    let node = veins.nodes.len() as u32;
    veins.nodes.push(place);
    let piece = |ends: [u32; 2], range: std::ops::RangeInclusive<usize>| {
        let mut piece = Vein {
            ends,
            points: vein.points[range.clone()].to_vec(),
            radii: vein.radii[range].to_vec(),
        };
        // Both pieces may have the same ends.
        if piece.points.len() == 2 {
            piece
                .points
                .insert(1, piece.points[0].midpoint(piece.points[1]));
            piece
                .radii
                .insert(1, 0.5 * (piece.radii[0] + piece.radii[1]));
        }
        piece
    };
    let last = vein.points.len() - 1;
    let pieces = [
        piece([vein.ends[0], node], 0..=i),
        piece([node, vein.ends[1]], i..=last),
    ];
    veins.list.splice(number..=number, pieces);
}

/// Lets the veins begin at the base: the middle line of the widest vein ends about its radius
/// before the margin, which cuts it.
fn join_base(veins: &mut Veins, root: &mut u32, base: DVec2, segment_px: f64) {
    let place = veins.nodes[*root as usize];
    let at_root = veins.list.iter().flat_map(|vein| {
        let ends = [
            (vein.ends[0], vein.radii[0]),
            (vein.ends[1], vein.radii[vein.radii.len() - 1]),
        ];
        ends.into_iter()
    });
    let radius = at_root
        .filter(|(end, _)| *end == *root)
        .fold(0.0, |most, (_, radius)| f64::max(most, radius));
    let off = place.distance(base);
    if off < 1.0 || off > 4.0 * radius + 4.0 {
        return;
    }
    let pieces = (off / segment_px).ceil().max(1.0) as usize;
    let points = (0..=pieces).map(|i| base.lerp(place, i as f64 / pieces as f64));
    let new = veins.nodes.len() as u32;
    veins.nodes.push(base);
    veins.list.push(Vein {
        ends: [new, *root],
        points: points.collect(),
        radii: vec![radius; pieces + 1],
    });
    *root = new;
}

/// The node from which each part of the veins starts, a wide one near the base; that of the longest
/// part is the first.
fn roots(veins: &Veins, frame: &Frame, findings: &mut Vec<Finding>) -> Vec<u32> {
    let (part, lengths) = parts(veins);
    let mut radii = vec![0.0_f64; veins.nodes.len()];
    for vein in &veins.list {
        for (side, end) in vein.ends.into_iter().enumerate() {
            let radius = radius_at_end(vein, side);
            let widest = &mut radii[end as usize];
            *widest = widest.max(radius);
        }
    }
    let mut nearest: Vec<(f64, u32)> = vec![(f64::INFINITY, 0); lengths.len()];
    for (node, &part) in (0..).zip(&part) {
        let off = veins.nodes[node as usize].distance(frame.base_px);
        let off = off - NEARER_BY * radii[node as usize];
        let best = &mut nearest[part as usize];
        if off < best.0 {
            *best = (off, node);
        }
    }
    let longest = (0..lengths.len()).fold(0, |best, part| {
        if lengths[part] > lengths[best] {
            part
        } else {
            best
        }
    });
    let mut roots = vec![nearest[longest].1];
    for (number, (_, root)) in nearest.into_iter().enumerate() {
        if number != longest {
            roots.push(root);
            let length_mm = lengths[number] * frame.mm_per_pixel;
            let place = veins.nodes[root as usize];
            findings.push(Finding::at(place, FindingKind::Apart { length_mm }));
        }
    }
    roots
}
