//! Light from single directions as a cosine series in azimuth.

use super::super::bidirectional::Lit;
use super::{Face, Leaving, Matrix, Ordinates, Slab, StackError, Swept};

impl Ordinates {
    /// Radiance of light that falls in from one direction, in the directions asked for, at each of
    /// these azimuths (rad) from the plane of incidence: 0 is the half-plane that the light goes
    /// on in. The outer order is that of azimuths.
    ///
    /// Every part of the light that goes as `cos mφ` is solved for, up to the last moment of the
    /// phase function. The forward peak that is cut off it counts as not scattered, so radiance
    /// near that of unscattered light is too low.
    ///
    /// # Errors
    ///
    /// [`StackError::NotSolvedFor`] for a direction that was not named when this was made.
    pub fn leaving_by_azimuth(
        &self,
        face: Face,
        cosine: f64,
        azimuths: &[f64],
    ) -> Result<Vec<Vec<Leaving>>, StackError> {
        let place = self.place(cosine)?;
        let [lit] = self.waves_of([face], &[place], usize::MAX);
        let lit = &lit[0];
        let leaving = |azimuth: &f64| {
            let of = |view: usize, side: usize| {
                let waves = lit.waves.iter().enumerate();
                waves
                    .map(|(mode, factors)| libm::cos(mode as f64 * azimuth) * factors[side][view])
                    .sum()
            };
            let each = self.cosines.iter().enumerate();
            each.map(|(view, cosine)| Leaving {
                cosine: *cosine,
                reflected: of(view, 0),
                transmitted: of(view, 1),
            })
            .collect()
        };
        Ok(azimuths.iter().map(leaving).collect())
    }

    /// Light of each of the first `incidences` cosines that were named when this was made, in the
    /// directions of all that follow, as a series in azimuth of no more than `most`
    /// waves, lit on either face.
    pub(in super::super) fn waves(&self, incidences: usize, most: usize) -> [Vec<Lit>; 2] {
        let places: Vec<usize> = (0..incidences).collect();
        let mut all = self.waves_of([Face::First, Face::Last], &places, most);
        for lit in all.iter_mut().flatten() {
            for factors in lit.waves.iter_mut().flatten() {
                factors.drain(..incidences);
            }
        }
        all
    }

    /// Light of the incidences at these places among the cosines, in the directions of all of them,
    /// as a series in azimuth of no more than `most` waves, lit on each of these faces.
    fn waves_of<const N: usize>(
        &self,
        faces: [Face; N],
        incidences: &[usize],
        most: usize,
    ) -> [Vec<Lit>; N] {
        let moments = self.resolution.moments();
        let entering = self.entering_at(incidences);
        let bare = self.elements_with(|layer, at| Slab::uncollided(layer, at, moments));
        let bare = faces.map(|face| Swept::new(&bare, face, &entering));
        let mut all = bare.each_ref().map(|bare| {
            let lit = |column| Lit {
                unscattered: [&bare.back, &bare.through].map(|light| self.flux(light, column)),
                waves: Vec::new(),
            };
            (0..incidences.len()).map(lit).collect::<Vec<_>>()
        });
        for mode in 0..moments.min(most) {
            let of_mode;
            let elements = if mode == 0 {
                &self.elements
            } else {
                of_mode = self.elements_with(|layer, at| Slab::new(layer, at, mode, moments));
                &of_mode
            };
            let twice = if mode == 0 { 1.0 } else { 2.0 };
            for ((face, bare), all) in faces.into_iter().zip(&bare).zip(&mut all) {
                let swept = Swept::new(elements, face, &entering);
                let scattered = |all: Matrix, straight: &Matrix| {
                    all.zip(straight, |all, straight| twice * (all - straight))
                };
                let sides = [
                    scattered(swept.back, &bare.back),
                    scattered(swept.through, &bare.through),
                ];
                for (column, lit) in all.iter_mut().enumerate() {
                    let factors = |light| self.radiance(light, column).collect();
                    lit.waves.push(sides.each_ref().map(factors));
                }
            }
        }
        all
    }
}
