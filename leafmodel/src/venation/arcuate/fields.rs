//! The fields of the article's shader at a point.

use glam::DVec2;

use super::layout::ArcuateVeins;
use super::layout::Vein;

/// The article's texture fields at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArcuateFields {
    /// `Vein`: whether the point lies on a vein.
    pub vein: bool,
    /// `Net`: whether it lies near enough to a vein for the finer net.
    pub net: bool,
    /// `Fac`: 0 off the veins; on them √(1 − distance over `Width`), 1 on the centre line.
    pub fac: f64,
}

impl ArcuateVeins {
    /// The fields at a point, mm.
    ///
    /// Where veins overlap, Fac is that of the midrib, else of the first vein found from base to
    /// tip, as in the article's code. Unlike in that code, Net is evaluated over all veins, even
    /// after a vein was found.
    pub(crate) fn fields_at(&self, p: DVec2) -> ArcuateFields {
        let p = self.frame.to_leaf(p);
        let mut fields = ArcuateFields {
            vein: false,
            net: false,
            fac: 0.0,
        };
        for vein in &self.laterals {
            let Some(nearest) = vein.curve.nearest(p) else {
                continue;
            };
            fields.net |= nearest.distance < self.plan.net_width;
            let half_width = self.lateral_radius(vein, nearest.t, p);
            if !fields.vein && nearest.distance < half_width {
                fields = self.on_vein(fields, nearest.distance);
            }
        }
        for primary in &self.axes[1..] {
            let Some(nearest) = primary.curve.nearest(p) else {
                continue;
            };
            fields.net |= nearest.distance < self.plan.net_width;
            if nearest.distance < self.axis_radius(primary, nearest.t) {
                fields = self.on_vein(fields, nearest.distance);
            }
        }
        let distance = (p - DVec2::new(p.x.clamp(0.0, 1.0), 0.0)).length();
        fields.net |= distance < self.plan.net_width;
        if distance < self.axis_radius(&self.axes[0], p.x) {
            fields = self.on_vein(fields, distance);
        }
        fields
    }

    fn on_vein(&self, fields: ArcuateFields, distance: f64) -> ArcuateFields {
        ArcuateFields {
            vein: true,
            // Below the base the midrib is wider than `Width`, where the difference is negative.
            fac: (1.0 - distance / self.plan.width).max(0.0).sqrt(),
            ..fields
        }
    }

    /// Half width of an axis at a share of its length, leaf units.
    pub(super) fn axis_radius(&self, axis: &Vein, share: f64) -> f64 {
        self.plan.width * self.taper(axis.start) * self.taper(share)
    }

    /// Half width of a lateral at its parameter `t`, near the point `p`: it tapers along itself and
    /// along its axis.
    pub(super) fn lateral_radius(&self, vein: &Vein, t: f64, p: DVec2) -> f64 {
        let axis = &self.axes[vein.axis];
        let [from, _, to] = axis.curve.0;
        let along = (p - from).dot(to - from) / (to - from).length_squared();
        self.axis_radius(axis, along) * self.taper(t)
    }

    /// The taper, from 1 at the base to `tip_width` at the tip.
    fn taper(&self, share: f64) -> f64 {
        1.0 - (1.0 - self.plan.tip_width) * share
    }
}
