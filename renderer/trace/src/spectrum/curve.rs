//! Spectra as functions that paths evaluate.

use super::written;
use crate::spectrum::grid::{Share, Wavelengths};
use crate::spectrum::lanes::Lanes;
use crate::spectrum::{cie, planck};

/// A function of wavelength: constant, or linear between points and constant outside them.
///
/// Whether a table covers the film's range is checked when a scene is read.
#[derive(Clone, Debug, PartialEq)]
pub enum Curve {
    /// The same at every wavelength.
    Constant(f32),
    /// Points at equal steps.
    Uniform {
        /// Wavelength of the first value, nm.
        first_nm: f32,
        /// One over the step, nm⁻¹.
        per_nm: f32,
        /// At least two values.
        values: Box<[f32]>,
    },
    /// Points at wavelengths that rise strictly.
    Points {
        /// At least two wavelengths, nm.
        nm: Box<[f64]>,
        /// A value for each.
        values: Box<[f32]>,
    },
}

impl Curve {
    /// The curve of a spectrum as written in a scene.
    pub fn from_description(spectrum: &written::Spectrum) -> Self {
        match spectrum {
            written::Spectrum::Constant(value) => Self::Constant(*value as f32),
            written::Spectrum::Table { points, .. } => Self::from_points(points),
            written::Spectrum::D65 { scale } => {
                Self::uniform(300.0, 1.0, 530, |nm| scale * cie::d65(nm) / cie::d65(560.0))
            }
            written::Spectrum::Blackbody { kelvin, scale } => {
                let reference = planck::radiance(560.0, *kelvin);
                Self::uniform(300.0, 1.0, 2300, |nm| {
                    scale * planck::radiance(nm, *kelvin) / reference
                })
            }
        }
    }

    /// A curve that is linear between `(nm, value)` points, which must rise strictly in wavelength.
    pub fn from_points(points: &[(f64, f64)]) -> Self {
        match points {
            [] => Self::Constant(0.0),
            [(_, value)] => Self::Constant(*value as f32),
            _ => Self::Points {
                nm: points.iter().map(|point| point.0).collect(),
                values: points.iter().map(|point| point.1 as f32).collect(),
            },
        }
    }

    /// A curve through `f` at `first_nm`, `first_nm + step_nm`, … with `intervals` intervals.
    pub fn uniform(first_nm: f64, step_nm: f64, intervals: usize, f: impl Fn(f64) -> f64) -> Self {
        Self::Uniform {
            first_nm: first_nm as f32,
            per_nm: (1.0 / step_nm) as f32,
            values: (0..=intervals)
                .map(|i| f(first_nm + i as f64 * step_nm) as f32)
                .collect(),
        }
    }

    /// Value at a wavelength in nm.
    pub fn at(&self, nm: f32) -> f32 {
        match self {
            Self::Constant(value) => *value,
            Self::Uniform {
                first_nm,
                per_nm,
                values,
            } => {
                let place = ((nm - first_nm) * per_nm).clamp(0.0, (values.len() - 1) as f32);
                let below = (place as usize).min(values.len() - 2);
                let share = place - below as f32;
                values[below] * (1.0 - share) + values[below + 1] * share
            }
            Self::Points { nm: places, values } => {
                let above = places.partition_point(|&place| place as f32 <= nm);
                if above == 0 {
                    return values[0];
                }
                if above == places.len() {
                    return values[above - 1];
                }
                let [low, high] = [above - 1, above].map(|i| places[i] as f32);
                let share = (nm - low) / (high - low);
                values[above - 1] * (1.0 - share) + values[above] * share
            }
        }
    }

    /// Values at a path's wavelengths.
    pub fn lanes<const N: usize>(&self, wavelengths: &Wavelengths<N>) -> Lanes<N> {
        match self {
            Self::Constant(value) => Lanes::splat(*value),
            Self::Uniform { .. } | Self::Points { .. } => {
                Lanes::from_fn(|i| self.at(wavelengths.nm[i]))
            }
        }
    }

    /// The curve times a factor.
    #[must_use]
    pub fn scaled(mut self, factor: f32) -> Self {
        match &mut self {
            Self::Constant(value) => *value *= factor,
            Self::Uniform { values, .. } | Self::Points { values, .. } => {
                values.iter_mut().for_each(|value| *value *= factor);
            }
        }
        self
    }

    /// The points, in nm, between which it is linear and outside which it keeps its end values.
    pub fn points(&self) -> Vec<(f64, f64)> {
        match self {
            Self::Constant(value) => vec![(560.0, f64::from(*value))],
            Self::Uniform {
                first_nm,
                per_nm,
                values,
            } => {
                let nm = |i: usize| f64::from(*first_nm) + i as f64 / f64::from(*per_nm);
                let points = values.iter().enumerate();
                points
                    .map(|(i, value)| (nm(i), f64::from(*value)))
                    .collect()
            }
            Self::Points { nm, values } => {
                let points = nm.iter().zip(values);
                points.map(|(nm, value)| (*nm, f64::from(*value))).collect()
            }
        }
    }

    /// Number of points, and the wavelength and the value of one, nm.
    fn point(&self) -> (usize, impl Fn(usize) -> (f64, f64)) {
        let count = match self {
            Self::Constant(_) => 1,
            Self::Uniform { values, .. } | Self::Points { values, .. } => values.len(),
        };
        let point = move |i: usize| match self {
            Self::Constant(value) => (560.0, f64::from(*value)),
            Self::Uniform {
                first_nm,
                per_nm,
                values,
            } => {
                let nm = f64::from(*first_nm) + i as f64 / f64::from(*per_nm);
                (nm, f64::from(values[i]))
            }
            Self::Points { nm, values } => (nm[i], f64::from(values[i])),
        };
        (count, point)
    }

    /// Mean over what a wavelength represents: exact, so that no line is too narrow to count.
    pub fn over(&self, share: &Share) -> f32 {
        let [first, last] = share.edges_nm;
        let (count, point) = self.point();
        let (mut low, mut high) = (0, count);
        while low < high {
            let middle = usize::midpoint(low, high);
            if point(middle).0 <= first {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        // Where it is straight, the mean is the value in the middle.
        if low == count || point(low).0 >= last {
            return self.at(share.nm);
        }
        let value = |nm: f64, i: usize| {
            let next = point(i.min(count - 1));
            let before = point(i.saturating_sub(1));
            if i == 0 || i == count {
                return next.1;
            }
            before.1 + (next.1 - before.1) * (nm - before.0) / (next.0 - before.0)
        };
        let mut from = (first, value(first, low));
        let mut sum = 0.0;
        while low < count && point(low).0 < last {
            let to = point(low);
            sum += 0.5 * (from.1 + to.1) * (to.0 - from.0);
            from = to;
            low += 1;
        }
        sum += 0.5 * (from.1 + value(last, low)) * (last - from.0);
        (sum / (last - first)) as f32
    }

    /// The curve as a scene would write it.
    pub fn written(&self) -> written::Spectrum {
        written::Spectrum::Table {
            points: self.points(),
            extrapolate: true,
        }
    }

    /// Mean over a range in nm.
    pub(crate) fn mean_over(&self, [first, last]: [f64; 2]) -> f32 {
        self.over(&Share::around(0.5 * (first + last), last - first))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_is_the_one_through_its_points() {
        let uniform = Curve::uniform(400.0, 5.0, 40, |nm| (nm / 50.0).sin() + 2.0);
        let points = Curve::from_points(&[(400.0, 1.0), (420.0, 3.0), (600.0, 2.0)]);
        for curve in [uniform, points, Curve::Constant(0.5)] {
            let again = Curve::from_points(&curve.points());
            for nm in [380.0, 402.5, 411.0, 599.0, 700.0] {
                assert!(
                    (curve.at(nm) - again.at(nm)).abs() < 1e-6,
                    "{curve:?} at {nm}"
                );
            }
        }
    }

    #[test]
    fn a_table_is_linear_between_its_points_and_constant_outside() {
        let curve = Curve::from_points(&[(400.0, 0.0), (500.0, 1.0), (520.0, 0.5)]);
        let expected = [
            (390.0, 0.0),
            (400.0, 0.0),
            (450.0, 0.5),
            (510.0, 0.75),
            (900.0, 0.5),
        ];
        for (nm, value) in expected {
            assert!(
                (curve.at(nm) - value).abs() < 1e-6,
                "{nm} nm gives {}",
                curve.at(nm)
            );
        }
    }

    #[test]
    fn uniform_points_mean_the_same_as_a_table() {
        let f = |nm: f64| (nm - 400.0) * (nm - 400.0);
        let uniform = Curve::uniform(400.0, 5.0, 20, f);
        let points: Vec<_> = (0..=20)
            .map(|i| 400.0 + 5.0 * f64::from(i))
            .map(|nm| (nm, f(nm)))
            .collect();
        let table = Curve::from_points(&points);
        for i in 0..200 {
            let nm = 395.0 + 0.6 * i as f32;
            assert!((uniform.at(nm) - table.at(nm)).abs() < 1e-2, "{nm}");
        }
    }
}
