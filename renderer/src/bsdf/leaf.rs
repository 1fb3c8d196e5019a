//! The leaf: two faces with rough coats over a tissue with two reflectances and one transmittance.
//!
//! `docs/src/theory/leaf-bsdf.md` describes the model; the symbols are the same.

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};

use crate::bsdf::directional_albedo::DirectionalAlbedo;
use crate::bsdf::fresnel;
use crate::bsdf::ggx::Ggx;
use crate::bsdf::{BsdfSample, Scattered};
use crate::sampling::warp;
use crate::spectrum::{Lanes, Table, WavelengthGrid, Wavelengths};

/// The rough dielectric coat of one face, with its tables.
#[derive(Clone, Debug)]
pub struct Coat {
    ggx: Ggx,
    eta: f32,
    albedo: DirectionalAlbedo,
}

impl Coat {
    /// A coat of refractive index `eta` and GGX roughness across and along the main vein.
    pub fn new(eta: f32, alpha_across: f32, alpha_along: f32) -> Self {
        let ggx = Ggx {
            alpha_x: alpha_across,
            alpha_y: alpha_along,
        };
        Self {
            ggx,
            eta,
            albedo: DirectionalAlbedo::new(ggx, eta),
        }
    }

    /// Whether the coat reflects anything.
    #[inline]
    fn shines(&self) -> bool {
        self.eta != 1.0
    }

    /// `E(w)`.
    #[inline]
    fn reflected(&self, w: Vec3) -> f32 {
        if self.shines() {
            self.albedo.at(w)
        } else {
            0.0
        }
    }

    /// Its refractive index and its roughness across and along.
    pub fn numbers(&self) -> (f32, [f32; 2]) {
        (self.eta, [self.ggx.alpha_x, self.ggx.alpha_y])
    }

    /// The directional albedo of the coat's lobe.
    pub fn albedo(&self) -> &DirectionalAlbedo {
        &self.albedo
    }

    /// The lobe's value and its sampling density from `wo`, whose Λ is `lambda`; for two directions
    /// on the side +z.
    #[inline]
    fn lobe(&self, wo: Vec3, lambda: f32, wi: Vec3) -> (f32, f32) {
        coat_lobe(self.ggx, self.eta, wo, lambda, wi)
    }

    /// `1 − Ē`.
    fn passed_mean(&self) -> f32 {
        1.0 - self.albedo.mean()
    }
}

/// The lobe of a coat of refractive index `eta`: its value and its sampling density from `wo`, whose
/// Λ is `lambda`; for two directions on the side +z.
#[inline]
pub(super) fn coat_lobe(ggx: Ggx, eta: f32, wo: Vec3, lambda: f32, wi: Vec3) -> (f32, f32) {
    let Some(h) = (wo + wi).try_normalize() else {
        return (0.0, 0.0);
    };
    let fresnel = fresnel::dielectric(wo.dot(h), eta);
    let shared = ggx.d(h) / (4.0 * wo.z);
    let shadowed = 1.0 / (1.0 + lambda + ggx.lambda(wi));
    (shared * shadowed * fresnel / wi.z, shared / (1.0 + lambda))
}

/// Reflectances and transmittances of the tissue for light that has passed the coats.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tissue<const N: usize> {
    /// `r` of the adaxial and the abaxial face.
    reflectance: [Lanes<N>; 2],
    /// `t` of light that enters by the adaxial and by the abaxial face.
    transmittance: [Lanes<N>; 2],
}

/// By how much the abaxial reflectance of tissue that absorbs all light exceeds the adaxial one.
const EXCESS: f32 = 0.7;

/// Abaxial over adaxial reflectance of a leaf of reflectance `R` and transmittance `T` of which
/// nothing else is known: `1 + 0.7 A² (3 − 2 A)` of its absorptance `A = 1 − R − T`.
///
/// 1 for tissue that absorbs nothing, as 0.97 is measured at 800 nm; for green leaves within 5 % of
/// the means that Noda et al. measured at 450, 550, 680 and 800 nm. The abaxial face absorbs at
/// least 0.63 of what the adaxial one does, whatever `R` and `T`.
#[inline]
pub fn usual_abaxial_ratio<const N: usize>(
    reflectance: Lanes<N>,
    transmittance: Lanes<N>,
) -> Lanes<N> {
    let mut ratio = Lanes::ONE;
    for lane in 0..N {
        let a = (1.0 - reflectance.0[lane] - transmittance.0[lane]).clamp(0.0, 1.0);
        ratio.0[lane] += EXCESS * a * a * (3.0 - 2.0 * a);
    }
    ratio
}

/// A leaf at one point.
#[derive(Clone, Debug)]
pub struct LeafBsdf<'a, const N: usize> {
    /// Adaxial and abaxial.
    coats: &'a [Coat; 2],
    tissue: Tissue<N>,
}

/// A leaf at one point, seen from one direction, with everything that does not depend on the
/// direction of the light.
#[derive(Clone, Debug)]
pub struct LeafView<'a, const N: usize> {
    /// Coats of the side of the view, and of the other.
    coats: [&'a Coat; 2],
    wo: Vec3,
    /// Λ of the coat for the view.
    lambda: f32,
    /// `f` of reflected and of transmitted diffuse light, without the factor for the coat on the
    /// side of `wi`.
    reflecting: Lanes<N>,
    through: Lanes<N>,
    /// Probabilities of the coat, of tissue reflection and of transmission.
    lobes: [f32; 3],
}

fn above(w: Vec3) -> Vec3 {
    Vec3::new(w.x, w.y, w.z.abs())
}

impl<const N: usize> Tissue<N> {
    /// The tissue of a leaf, from its reflectance `R` and transmittance `T` at normal incidence on
    /// the adaxial face and the ratio `ratio` of abaxial to adaxial reflectance.
    pub fn new(
        coats: &[Coat; 2],
        reflectance: Lanes<N>,
        transmittance: Lanes<N>,
        ratio: Lanes<N>,
    ) -> Self {
        let [normal_a, normal_b] = coats.each_ref().map(|coat| coat.albedo.normal());
        let [passed_a, passed_b] = coats.each_ref().map(Coat::passed_mean);
        let most = (passed_b / passed_a).min(1.0);
        let (into_a, into_b) = (1.0 / (1.0 - normal_a), 1.0 / (1.0 - normal_b));
        let back = passed_a / passed_b;
        let mut tissue = Self {
            reflectance: [Lanes::ZERO; 2],
            transmittance: [Lanes::ZERO; 2],
        };
        for lane in 0..N {
            let (r, t) = (reflectance.0[lane], transmittance.0[lane]);
            let t_ab = (t * into_a).min(most);
            let t_ba = (t_ab * back).min(1.0);
            let r_a = ((r - normal_a) * into_a).max(0.0).min(1.0 - t_ab);
            let absorbed = (1.0 - ratio.0[lane] * r - t).max(0.0) * into_b;
            let r_b = (1.0 - t_ba - absorbed).max(0.0).min(1.0 - t_ba);
            tissue.reflectance[0].0[lane] = r_a;
            tissue.reflectance[1].0[lane] = r_b;
            tissue.transmittance[0].0[lane] = t_ab;
            tissue.transmittance[1].0[lane] = t_ba;
        }
        tissue
    }

    /// The same reflectances with the transmittance of light that entered elsewhere. Where both
    /// faces could not send back what they do and let so much through, they let less through.
    #[must_use]
    #[inline]
    pub fn passing(mut self, coats: &[Coat; 2], transmittance: Lanes<N>) -> Self {
        let into = 1.0 / (1.0 - coats[0].albedo.normal());
        let back = coats[0].passed_mean() / coats[1].passed_mean();
        let [r_a, r_b] = self.reflectance;
        for lane in 0..N {
            let most = (1.0 - r_a.0[lane]).min((1.0 - r_b.0[lane]) / back);
            let t_ab = (transmittance.0[lane] * into).min(most);
            self.transmittance[0].0[lane] = t_ab;
            self.transmittance[1].0[lane] = t_ab * back;
        }
        self
    }

    /// Its numbers, to be stored in a table.
    pub fn to_lanes(self) -> [Lanes<N>; 4] {
        let [r_a, r_b] = self.reflectance;
        let [t_ab, t_ba] = self.transmittance;
        [r_a, r_b, t_ab, t_ba]
    }

    /// `r` of a face, and `t` of light that enters by it and by the other.
    pub(super) fn seen(&self, side: usize) -> (Lanes<N>, [Lanes<N>; 2]) {
        let t = [side, 1 - side].map(|face| self.transmittance[face]);
        (self.reflectance[side], t)
    }

    /// The inverse of [`Tissue::to_lanes`].
    #[inline]
    pub fn from_lanes([r_a, r_b, t_ab, t_ba]: [Lanes<N>; 4]) -> Self {
        Self {
            reflectance: [r_a, r_b],
            transmittance: [t_ab, t_ba],
        }
    }
}

impl Tissue<1> {
    /// Tabulates a uniform leaf at every wavelength of a grid.
    pub fn table(grid: &WavelengthGrid, at: impl Fn(&Wavelengths<1>) -> Self) -> Table {
        Table::new(grid, |nm| {
            let lanes = at(&Wavelengths::new([nm])).to_lanes();
            lanes.map(|lanes| lanes.0[0])
        })
    }
}

impl<'a, const N: usize> LeafBsdf<'a, N> {
    /// Tissue under the adaxial and the abaxial coat for which it was made.
    #[inline]
    pub fn new(coats: &'a [Coat; 2], tissue: Tissue<N>) -> Self {
        Self { coats, tissue }
    }

    /// Its tissue.
    pub(super) fn tissue(&self) -> &Tissue<N> {
        &self.tissue
    }

    /// The leaf seen from `wo`; `None` from within its plane.
    #[inline]
    pub fn seen_from(&self, wo: Vec3) -> Option<LeafView<'a, N>> {
        if wo.z == 0.0 {
            return None;
        }
        let side = usize::from(wo.z < 0.0);
        let coats = [&self.coats[side], &self.coats[1 - side]];
        let [coat, _] = coats;
        let albedo = coat.reflected(wo);
        let passed = 1.0 - albedo;
        let reflectance = self.tissue.reflectance[side];
        let transmittance = self.tissue.transmittance[side];
        let reflected = passed * reflectance.mean();
        let transmitted = passed * transmittance.mean();
        let total = albedo + reflected + transmitted;
        let share = if total > 0.0 { 1.0 / total } else { 0.0 };
        // c(A, B) is the same in both directions.
        let through = self.tissue.transmittance[0] * (1.0 / self.coats[1].passed_mean());
        Some(LeafView {
            coats,
            wo,
            lambda: if coat.shines() {
                coat.ggx.lambda(above(wo))
            } else {
                0.0
            },
            reflecting: reflectance * (passed * FRAC_1_PI / coat.passed_mean()),
            through: through * (passed * FRAC_1_PI),
            lobes: [albedo, reflected, transmitted].map(|lobe| lobe * share),
        })
    }

    /// `f(wo, wi)`, sr⁻¹.
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> Lanes<N> {
        let view = self.seen_from(wo);
        view.map_or(Lanes::ZERO, |view| view.scatter(wi).f)
    }

    /// Density of [`LeafBsdf::sample`], sr⁻¹.
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.seen_from(wo).map_or(0.0, |view| view.scatter(wi).pdf)
    }

    /// Samples a direction; lobes are chosen in proportion to the light that they scatter.
    pub fn sample(&self, wo: Vec3, lobe: f32, u: Vec2) -> Option<BsdfSample<N>> {
        self.seen_from(wo)?.sample(lobe, u)
    }

    /// Share of the diffuse light on the face that `wo` sees which the leaf scatters, to either
    /// side.
    pub fn albedo(&self, wo: Vec3) -> Lanes<N> {
        let side = usize::from(wo.z < 0.0);
        let coat = self.coats[side].albedo.mean();
        (self.tissue.reflectance[side] + self.tissue.transmittance[side]) * (1.0 - coat)
            + Lanes::splat(coat)
    }
}

impl<const N: usize> LeafView<'_, N> {
    /// The BSDF's value for light from `wi`, and the density with which `wi` is sampled.
    #[inline]
    pub fn scatter(&self, wi: Vec3) -> Scattered<N> {
        if wi.z == 0.0 {
            return Scattered::NOTHING;
        }
        let [coat, other] = self.coats;
        let [shining, reflected, transmitted] = self.lobes;
        let cosine = wi.z.abs() * FRAC_1_PI;
        if self.wo.z * wi.z < 0.0 {
            return Scattered {
                f: self.through * (1.0 - other.reflected(wi)),
                pdf: transmitted * cosine,
            };
        }
        let diffuse = Scattered {
            f: self.reflecting * (1.0 - coat.reflected(wi)),
            pdf: reflected * cosine,
        };
        if !coat.shines() {
            return diffuse;
        }
        let (lobe, pdf) = coat.lobe(above(self.wo), self.lambda, above(wi));
        Scattered {
            f: diffuse.f + Lanes::splat(lobe),
            pdf: diffuse.pdf + shining * pdf,
        }
    }

    /// Samples a direction; lobes are chosen in proportion to the light that they scatter.
    #[inline]
    pub fn sample(&self, lobe: f32, u: Vec2) -> Option<BsdfSample<N>> {
        let [coat, reflected, transmitted] = self.lobes;
        let up = if lobe < coat {
            let outward = above(self.wo);
            let h = self.coats[0].ggx.sample_visible(outward, u);
            2.0 * outward.dot(h) * h - outward
        } else {
            warp::cosine_hemisphere(u)
        };
        if up.z <= 0.0 || reflected + transmitted + coat == 0.0 {
            return None;
        }
        let through = lobe >= coat + reflected;
        let side = 1.0_f32.copysign(self.wo.z);
        let wi = Vec3::new(up.x, up.y, if through { -side * up.z } else { side * up.z });
        let Scattered { f, pdf } = self.scatter(wi);
        (pdf > 0.0).then(|| BsdfSample {
            wi,
            weight: f * (wi.z.abs() / pdf),
            pdf,
            specular: false,
        })
    }
}
