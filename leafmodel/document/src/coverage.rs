//! Whether spectral data reach over the wavelengths that a document needs.

use super::context::Context;
use super::error::DocumentError;
use super::source::Place;

/// Whether data reach over the wavelengths that are needed; an error, or a warning with `extrapolate`.
pub fn require_coverage(cx: &Context, at: &Place, what: &str, covered: [f64; 2]) -> bool {
    let Some(needed) = cx.range_nm.get() else {
        return true;
    };
    if covered[0] <= needed[0] && covered[1] >= needed[1] {
        return true;
    }
    let by = cx.needed_by.get();
    if cx.extrapolate.get() {
        let message = format!(
            "{what} covers {} to {} nm and goes on with its end values over {by}'s {} to {} nm",
            covered[0], covered[1], needed[0], needed[1]
        );
        let help = format!("narrow {by}'s range if that is not meant");
        cx.warn(at, "scene::extrapolated", message, &help);
        return true;
    }
    let error = DocumentError::Coverage {
        what: what.to_owned(),
        from_nm: covered[0],
        to_nm: covered[1],
        need_from_nm: needed[0],
        need_to_nm: needed[1],
        by,
    };
    cx.error(at, error);
    false
}
