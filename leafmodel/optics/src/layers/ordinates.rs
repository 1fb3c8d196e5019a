//! Discrete ordinates and adding: the fast route, exact but for the number of directions.

use std::f64::consts::PI;

use super::boundary::reflectance;
use super::directions::{Direction, Directions};
use super::matrix::Matrix;
use super::slab::Slab;
use super::stack::{Face, Incidence, Layer, Stack, StackError};

mod waves;

/// How finely directions are resolved.
///
/// The phase function keeps half as many moments again before its forward peak is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Resolution(usize);

impl Resolution {
    /// For figures: all fluxes of the anchors within 1e-6 (a test measures it).
    pub const FINE: Self = Self(48);
    /// For spectra: fluxes of leaves within 1e-4; of the anchors within 4e-4 at normal and 2e-5 at
    /// Lambertian incidence.
    pub const FAST: Self = Self(10);

    /// So many directions in each range between two indices, at least 2.
    pub fn new(directions: usize) -> Self {
        Self(directions.max(2))
    }

    fn moments(self) -> usize {
        self.0 * 3 / 2
    }
}

/// Where light of one incidence ends, as shares of what falls in.
#[derive(Clone, Debug, PartialEq)]
pub struct Fluxes {
    /// Sent back on the lit side, specular reflection included, in [0, 1].
    pub reflected: f64,
    /// Let through, unscattered light included, in [0, 1].
    pub transmitted: f64,
    /// Absorbed in each layer, from the first to the last whichever is lit.
    pub absorbed: Vec<f64>,
}

/// Light that leaves in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leaving {
    /// Cosine to the normal of the face that it leaves, in (0, 1].
    pub cosine: f64,
    /// π times radiance over irradiance on the lit side: 1 for a perfect diffuser. Light that was
    /// never scattered counts only where the incidence is Lambertian.
    pub reflected: f64,
    /// The same on the other side.
    pub transmitted: f64,
}

/// Part of a stack: a boundary or a layer. `down` lets through from its first side to its second;
/// `up`, the other way, is the transpose.
#[derive(Clone, Debug)]
struct Element {
    first: Matrix,
    last: Matrix,
    down: Matrix,
    /// Which layer it is.
    layer: Option<usize>,
}

impl Element {
    fn boundary(above: &[Direction], from: f64, below: &[Direction], to: f64) -> Self {
        let both = above.len().min(below.len());
        let at = |i: usize| {
            let (cosine, refracted) = (above[i].cosine(from), above[i].cosine(to));
            reflectance(from, to, cosine, refracted)
        };
        let shares: Vec<f64> = (0..both).map(at).collect();
        let back = |count: usize| {
            Matrix::from_fn(count, count, |i, j| match shares.get(i) {
                _ if i != j => 0.0,
                Some(share) => *share,
                None => 1.0,
            })
        };
        Self {
            first: back(above.len()),
            last: back(below.len()),
            down: Matrix::from_fn(below.len(), above.len(), |i, j| match shares.get(i) {
                Some(share) if i == j => 1.0 - share,
                Some(_) | None => 0.0,
            }),
            layer: None,
        }
    }

    fn turned(&self) -> Self {
        Self {
            first: self.last.clone(),
            last: self.first.clone(),
            down: self.down.transposed(),
            layer: self.layer,
        }
    }
}

/// A stack of layers, solved for every direction.
#[derive(Clone, Debug)]
pub struct Ordinates {
    stack: Stack,
    directions: Directions,
    resolution: Resolution,
    /// Cosines in air that may be asked for.
    cosines: Vec<f64>,
    elements: Vec<Element>,
}

impl Ordinates {
    /// Solves a stack for light that does not depend on azimuth. Light from one direction can be
    /// asked for, and radiance in a direction, if its cosine in air is among `cosines`.
    ///
    /// # Errors
    ///
    /// [`StackError::Direction`] for a cosine out of range.
    pub fn new(stack: &Stack, resolution: Resolution, cosines: &[f64]) -> Result<Self, StackError> {
        for &cosine in cosines {
            Incidence::Directional { cosine }.checked()?;
        }
        let indices = stack.layers().iter().map(|layer| layer.index);
        let directions = Directions::new(indices, resolution.0, cosines);
        let mut solved = Self {
            stack: stack.clone(),
            directions,
            resolution,
            cosines: cosines.to_vec(),
            elements: Vec::new(),
        };
        let moments = resolution.moments();
        solved.elements = solved.elements_with(|layer, at| Slab::new(layer, at, 0, moments));
        Ok(solved)
    }

    /// Boundaries and layers in turn.
    fn elements_with(&self, slab: impl Fn(&Layer, &[Direction]) -> Slab) -> Vec<Element> {
        let mut elements = Vec::new();
        let mut index = 1.0;
        for (number, layer) in self.stack.layers().iter().enumerate() {
            let above = self.directions.within(index);
            let below = self.directions.within(layer.index);
            if index != layer.index {
                elements.push(Element::boundary(above, index, below, layer.index));
            }
            let Slab {
                reflection,
                transmission,
            } = slab(layer, below);
            elements.push(Element {
                first: reflection.clone(),
                last: reflection,
                down: transmission,
                layer: Some(number),
            });
            index = layer.index;
        }
        let (above, below) = (self.directions.within(index), self.directions.within(1.0));
        if index != 1.0 {
            elements.push(Element::boundary(above, index, below, 1.0));
        }
        elements
    }

    /// Where light of each of these incidences ends, lit on one face.
    ///
    /// # Errors
    ///
    /// [`StackError::NotSolvedFor`] for a direction that was not named when this was made.
    pub fn fluxes(&self, face: Face, incidences: &[Incidence]) -> Result<Vec<Fluxes>, StackError> {
        let entering = self.entering(incidences)?;
        let swept = Swept::new(&self.elements, face, &entering);
        Ok((0..incidences.len())
            .map(|column| {
                let mut absorbed = vec![0.0; self.stack.layers().len()];
                for (layer, net_in, net_out) in &swept.layers {
                    let net = |light: &[Matrix; 2]| {
                        self.flux(&light[0], column) - self.flux(&light[1], column)
                    };
                    absorbed[*layer] = net(net_in) - net(net_out);
                }
                Fluxes {
                    reflected: self.flux(&swept.back, column),
                    transmitted: self.flux(&swept.through, column),
                    absorbed,
                }
            })
            .collect())
    }

    /// Radiance that leaves in the directions asked for when this was made, averaged over azimuth.
    ///
    /// # Errors
    ///
    /// [`StackError::NotSolvedFor`] for a direction that was not named when this was made.
    pub fn leaving(&self, face: Face, incidence: Incidence) -> Result<Vec<Leaving>, StackError> {
        let swept = self.scattered(face, incidence, &self.elements)?;
        let shares = self
            .radiance(&swept.back, 0)
            .zip(self.radiance(&swept.through, 0));
        Ok(self
            .cosines
            .iter()
            .zip(shares)
            .map(|(cosine, (reflected, transmitted))| Leaving {
                cosine: *cosine,
                reflected,
                transmitted,
            })
            .collect())
    }

    /// The place of a cosine among those that may be asked for.
    fn place(&self, cosine: f64) -> Result<usize, StackError> {
        let place = self.cosines.iter().position(|known| *known == cosine);
        place.ok_or(StackError::NotSolvedFor { cosine })
    }

    /// Light in air of unit flux from the directions of these places, a column for each.
    fn entering_at(&self, places: &[usize]) -> Matrix {
        let air = self.directions.within(1.0);
        let mut entering = Matrix::zero(air.len(), places.len());
        for (column, place) in places.iter().enumerate() {
            let row = self.directions.probe(*place);
            entering[[row, column]] = 1.0 / (2.0 * PI * air[row].root);
        }
        entering
    }

    /// The flux of light in air.
    fn flux(&self, light: &Matrix, column: usize) -> f64 {
        let roots = self.directions.within(f64::INFINITY).iter();
        let sum: f64 = roots
            .take(light.rows())
            .enumerate()
            .map(|(row, direction)| direction.root * light[[row, column]])
            .sum();
        2.0 * PI * sum
    }

    /// Light of one incidence in these elements, without what was never scattered if it falls in
    /// from one direction.
    fn scattered(
        &self,
        face: Face,
        incidence: Incidence,
        elements: &[Element],
    ) -> Result<Swept, StackError> {
        let entering = self.entering(&[incidence])?;
        let mut swept = Swept::new(elements, face, &entering);
        match incidence {
            Incidence::Directional { .. } => {
                let moments = self.resolution.moments();
                let bare = self.elements_with(|layer, at| Slab::uncollided(layer, at, moments));
                let bare = Swept::new(&bare, face, &entering);
                let less = |all: f64, straight: f64| all - straight;
                swept.back = swept.back.zip(&bare.back, less);
                swept.through = swept.through.zip(&bare.through, less);
            }
            Incidence::Lambertian => {}
        }
        Ok(swept)
    }

    /// π times radiance, of unit flux, in the directions asked for.
    fn radiance<'a>(&'a self, light: &'a Matrix, column: usize) -> impl Iterator<Item = f64> + 'a {
        let air = self.directions.within(1.0);
        (0..self.cosines.len()).map(move |place| {
            let row = self.directions.probe(place);
            PI * light[[row, column]] / air[row].root
        })
    }

    /// Light in air of unit flux, a column for each incidence.
    fn entering(&self, incidences: &[Incidence]) -> Result<Matrix, StackError> {
        let air = self.directions.within(1.0);
        let mut entering = Matrix::zero(air.len(), incidences.len());
        for (column, incidence) in incidences.iter().enumerate() {
            match incidence {
                Incidence::Directional { cosine } => {
                    let row = self.directions.probe(self.place(*cosine)?);
                    entering[[row, column]] = 1.0 / (2.0 * PI * air[row].root);
                }
                Incidence::Lambertian => {
                    let weights = air.iter().map(|direction| direction.root * direction.root);
                    let radiance = 1.0 / (2.0 * PI * weights.sum::<f64>());
                    for (row, direction) in air.iter().enumerate() {
                        entering[[row, column]] = direction.root * radiance;
                    }
                }
            }
        }
        Ok(entering)
    }
}

/// Light between all elements, for given light on one face.
struct Swept {
    /// What leaves the lit side, and the other.
    back: Matrix,
    through: Matrix,
    /// Light down and up at the two sides of each layer, in the sense of the sweep.
    layers: Vec<(usize, [Matrix; 2], [Matrix; 2])>,
}

impl Swept {
    /// Adds elements from the far side on, then follows the light from the lit side.
    ///
    /// # Source
    ///
    /// The adding equations, \[vandehulst1980\].
    fn new(elements: &[Element], face: Face, entering: &Matrix) -> Self {
        let turned: Vec<Element>;
        let elements = match face {
            Face::First => elements,
            Face::Last => {
                turned = elements.iter().rev().map(Element::turned).collect();
                &turned
            }
        };
        // What everything from an element on sends back; nothing comes from the air behind.
        let end = elements.last().map_or(0, |last| last.down.rows());
        let mut behind = vec![Matrix::zero(end, end)];
        for element in elements.iter().rev() {
            let far = &behind[behind.len() - 1];
            let between = one_less(&element.last.times(far));
            let down = between.solved(element.down.clone());
            let up = element.down.transposed().times(&far.times(&down));
            behind.push(element.first.clone().zip(&up, |own, more| own + more));
        }
        behind.reverse();
        let back = behind[0].times(entering);
        let mut light = entering.clone();
        let mut layers = Vec::new();
        for (element, pair) in elements.iter().zip(behind.windows(2)) {
            let [near, far] = pair else {
                unreachable!("windows of two have two")
            };
            let between = one_less(&element.last.times(far));
            let next = between.solved(element.down.times(&light));
            if let Some(layer) = element.layer {
                let above = [light.clone(), near.times(&light)];
                let below = [next.clone(), far.times(&next)];
                layers.push((layer, above, below));
            }
            light = next;
        }
        Self {
            back,
            through: light,
            layers,
        }
    }
}

fn one_less(matrix: &Matrix) -> Matrix {
    Matrix::from_fn(matrix.rows(), matrix.columns(), |i, j| {
        f64::from(u8::from(i == j)) - matrix[[i, j]]
    })
}
