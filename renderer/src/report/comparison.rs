//! Findings of a comparison: numbers as JSON and CSV, a page, and words.

pub(crate) mod csv;
mod figures;
pub(crate) mod html;
pub(crate) mod json;
pub(crate) mod overlay;
#[cfg(test)]
mod tests;
pub(crate) mod words;
