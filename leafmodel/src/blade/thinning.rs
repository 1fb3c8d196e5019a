//! Contents that fall towards the margin with the thickness of the blade.

use glam::DVec2;

use super::contents_map::ContentsMap;
use super::frame::UvFrame;
use super::margin_thickness::MarginThickness;
use crate::optics::Constituent;
use crate::plane::polygon;
use crate::shape::outline::Outline;

impl MarginThickness {
    /// Lets the contents of a map fall with the thickness.
    pub(crate) fn thin(&self, map: &mut ContentsMap, frame: &UvFrame, outline: &Outline) {
        if self.is_even() {
            return;
        }
        let size = DVec2::new(f64::from(map.width), f64::from(map.height));
        let texel = frame.size / size;
        // Texels beyond the margin continue those on it.
        let reach = self.width_mm + 2.0 * texel.max_element();
        let mut near = vec![false; map.texels.len()];
        let points = outline.points();
        for (a, b) in polygon::sides(points) {
            let pieces = (a.distance(b) / reach).ceil().max(1.0) as usize;
            for piece in 0..pieces {
                let [from, to] = [piece, piece + 1].map(|i| a.lerp(b, i as f64 / pieces as f64));
                let index = |p: DVec2| ((p - frame.min) / texel).clamp(DVec2::ZERO, size - 1.0);
                let (low, high) = (index(from.min(to) - reach), index(from.max(to) + reach));
                for row in low.y as usize..=high.y as usize {
                    near[row * map.width as usize..][low.x as usize..=high.x as usize].fill(true);
                }
            }
        }
        for (number, _) in near.iter().enumerate().filter(|(_, near)| **near) {
            let (column, row) = (number % map.width as usize, number / map.width as usize);
            let p = frame.min + texel * (DVec2::new(column as f64, row as f64) + 0.5);
            let inside = if outline.contains(p) {
                outline.distance_to_margin(p)
            } else {
                0.0
            };
            let share = self.at(inside) as f32;
            for (constituent, content) in map.texels[number].iter_mut() {
                if constituent != Constituent::Structure {
                    *content *= share;
                }
            }
        }
    }
}
