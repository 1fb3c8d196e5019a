//! Dead tissue about wounds and in mines, painted on maps of contents.

use glam::DVec2;

use crate::blade::contents_map::ContentsMap;
use crate::blade::frame::UvFrame;
use crate::optics::{Constituent, Contents};
use crate::plane::segment;

/// A band of dead tissue along a path.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Stain {
    /// Places and half widths, mm.
    path: Vec<(DVec2, f64)>,
    /// Share of the half width over which it fades.
    softness: f64,
    is_mine: bool,
}

impl Stain {
    /// The callus about a wound.
    pub(super) fn rim(edge: Vec<DVec2>, width_mm: f64) -> Self {
        Self {
            path: edge.into_iter().map(|p| (p, width_mm)).collect(),
            softness: 0.7,
            is_mine: false,
        }
    }

    /// A mine: the tissue between the faces has been eaten.
    pub(super) fn mine(path: Vec<(DVec2, f64)>) -> Self {
        Self {
            path,
            softness: 0.25,
            is_mine: true,
        }
    }

    /// What living tissue has become. A callus is cork: brown and dry. In a mine there is no green,
    /// and little water; droppings and what is left of the walls are brown.
    fn turned(&self, living: Contents) -> Contents {
        let mut dead = living;
        for (constituent, value) in dead.iter_mut() {
            *value *= match (constituent, self.is_mine) {
                (Constituent::Chlorophyll, _) => 0.04,
                (Constituent::Carotenoids, _) => 0.06,
                (Constituent::Anthocyanins | Constituent::Water, _) => 0.3,
                (
                    Constituent::DryMatter | Constituent::Proteins | Constituent::CarbonBased,
                    true,
                ) => 0.5,
                _ => 1.0,
            };
        }
        let brown = if self.is_mine { 0.3 } else { 1.2 };
        dead[Constituent::Brown] = dead[Constituent::Brown].max(brown);
        dead
    }

    /// Weight at a place, 0 to 1, by the piece of the path that covers it most.
    fn at(&self, p: DVec2) -> f64 {
        let piece = |a: (DVec2, f64), b: (DVec2, f64)| {
            let way = b.0 - a.0;
            let along = segment::share(a.0, b.0, p);
            let radius = a.1 + (b.1 - a.1) * along;
            let depth = 1.0 - (a.0 + way * along).distance(p) / radius;
            (depth / self.softness).clamp(0.0, 1.0)
        };
        let pieces = self.path.windows(2).map(|pair| piece(pair[0], pair[1]));
        pieces.fold(0.0, f64::max)
    }

    /// Paints it over a map.
    pub(crate) fn paint(&self, map: &mut ContentsMap, frame: &UvFrame) {
        let size = DVec2::new(f64::from(map.width), f64::from(map.height));
        let to_texel = |p: DVec2| (p - frame.min) / frame.size * size;
        let (low, high) = self.path.iter().fold(
            (DVec2::INFINITY, DVec2::NEG_INFINITY),
            |(low, high), &(p, radius)| (low.min(p - radius), high.max(p + radius)),
        );
        let (low, high) = (to_texel(low).floor(), to_texel(high).ceil());
        let span = |low: f64, high: f64, count: u32| {
            (low.max(0.0) as u32)..((high.max(0.0) as u32 + 1).min(count))
        };
        for row in span(low.y, high.y, map.height) {
            for column in span(low.x, high.x, map.width) {
                let uv = (DVec2::new(f64::from(column), f64::from(row)) + 0.5) / size;
                let weight = self.at(frame.point(uv));
                if weight > 0.0 {
                    let texel = &mut map.texels[(row * map.width + column) as usize];
                    let living = Contents::from_texel(*texel);
                    let dead = self.turned(living);
                    let mut now = living;
                    for (constituent, value) in now.iter_mut() {
                        *value += (dead[constituent] - *value) * weight;
                    }
                    *texel = now.to_texel();
                }
            }
        }
    }
}
