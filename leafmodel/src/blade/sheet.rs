//! A lamina without veins as a sheet of even triangles.

use glam::DVec2;

use super::error::BladeError;
use super::mesh::MOST_TRIANGLES;
use super::plan::BladeForm;
use super::size_field::SizeField;
use super::skeleton::Skeleton;
use super::triangulate::triangulate;
use crate::shape::outline::Outline;

/// Points (mm, the outline's frame) and counter-clockwise triangles, no edge longer than
/// `max_edge_mm`.
///
/// # Errors
///
/// [`BladeError::Range`] for an edge outside 0.001 to 10000 mm, [`BladeError::TooFine`] for a
/// sheet of too many triangles.
pub(crate) fn even_sheet(
    outline: &Outline,
    max_edge_mm: f64,
) -> Result<(Vec<DVec2>, Vec<[u32; 3]>), BladeError> {
    let form = BladeForm {
        max_edge_mm,
        ..BladeForm::nearly_flat(outline.length())
    };
    form.validate()?;
    let size = SizeField::new(&form, &[]);
    let sheet = triangulate(outline, &[], &size, &Skeleton::default(), MOST_TRIANGLES)?;
    Ok((sheet.points, sheet.triangles))
}
