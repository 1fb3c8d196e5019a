//! Where the blade of a leaf has come to lie.

use super::lamina::Lamina;
use super::plan::LeafPlan;
use crate::blade::mesh::BladeMesh;
use crate::blade::stalk::StalkMesh;
use crate::blade::stance::Settled;
use crate::optics::Constituent;

impl LeafPlan {
    /// Where the blade of a lamina has come to lie.
    pub(super) fn settled(&self, lamina: &Lamina) -> Option<Settled> {
        let (outline, network) = (&lamina.outline, &lamina.network);
        let stalk = self.petiole.map(|petiole| {
            let length = petiole.length * outline.length();
            [length, petiole.radius_on(outline, network)]
        });
        let held = &self.tissue.lamina;
        Settled::of(
            &self.stance,
            &self.form,
            (outline, network),
            [held[Constituent::Water], held.all_dry_matter()],
            stalk,
            self.seed,
        )
    }
}

/// Lifts a leaf so that its lowest point touches the plane z = 0.
pub(super) fn put_on_ground(mesh: &mut BladeMesh, mut petiole: Option<&mut StalkMesh>) {
    let stalk = petiole.iter().flat_map(|stalk| &stalk.positions);
    let stalk = stalk.map(|p| p.z);
    // A closed blade is half its thickness lower than its sheet.
    let halves = mesh.across.iter().zip(&mesh.thickness_mm);
    let halves = halves.map(|(across, thickness)| 0.5 * thickness * across.z.abs());
    let halves = halves.chain(std::iter::repeat(0.0));
    let blade = mesh.positions.iter().zip(halves);
    let blade = blade.map(|(p, half)| p.z - half);
    let lowest = blade.chain(stalk).fold(f64::INFINITY, f64::min);
    let stalk = petiole.iter_mut().flat_map(|stalk| &mut stalk.positions);
    for p in mesh.positions.iter_mut().chain(stalk) {
        p.z -= lowest;
    }
}

#[cfg(test)]
mod tests;
