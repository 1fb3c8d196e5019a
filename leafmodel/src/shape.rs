//! The flat lamina: its margin, drawn by hand, read from a file or grown.
//!
//! ```
//! use leafmodel::shape::svg_path::SvgContour;
//!
//! // A path of an SVG file becomes the margin of a leaf 40 mm long: base at the origin, midrib along +y.
//! let drawing = r#"<svg xmlns="http://www.w3.org/2000/svg"><path d="M5 20 Q11 8 5 0 Q-1 8 5 20 Z"/></svg>"#;
//! let margin = SvgContour::parse("drawn.svg", drawing, None)?.grow(40.0)?;
//! assert_eq!(margin.length(), 40.0);
//! assert!(margin.contains(glam::DVec2::new(0.0, 20.0)));
//! assert!((300.0..400.0).contains(&margin.area()), "{} mm²", margin.area());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod contour_curve;
pub(crate) mod cubic;
pub mod cubic_margin;
pub(crate) mod drawing;
pub mod growth;
pub mod growth_form;
pub(crate) mod outer_boundary;
pub mod outline;
pub(crate) mod rates;
pub mod specimen;
pub mod svg_path;
pub mod teeth;
pub mod tips;
