//! Which layer of a picture is used.

use leafmodel::document::declared::Declared;
use leafmodel::document::value_kind::Text;

/// The layer of an EXR; `None` is that without a name.
#[derive(Clone, Debug, Declared, Default, PartialEq)]
pub struct ChosenLayer(
    /// The layer of an EXR whose channels R, G and B, or Y alone, are used: `sky` has `sky.R`. Without it the
    /// channels without a layer are.
    #[key("layer", Text("the name of a layer of the EXR"))]
    pub Option<String>,
);

impl ChosenLayer {
    /// Its name.
    pub fn name(&self) -> Option<&str> {
        self.0.as_deref()
    }
}
