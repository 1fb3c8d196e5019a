//! Leaves grown from biology, as data: outline, veins, blade, contents, optics.
//!
//! Lengths are millimetres, angles radians, numbers `f64`. The crate knows nothing of light
//! paths or images.
//!
//! # A tour
//!
//! A leaf starts as a plan ([`leaf::LeafPlan`]): every number that decides it, with its unit.
//! [`species`] holds plans of birch, maple, oak and others, and a plan is data: change what you
//! want to know about. [`Leaf::grow`](leaf::Leaf::grow) carries it out. The margin ([`shape`])
//! comes first, then the veins ([`venation`], [`transport`]), then the blade in space with what its
//! tissue holds ([`blade`]).
//!
//! ```
//! use leafmodel::export::{SvgStyle, svg};
//! use leafmodel::leaf::Leaf;
//! use leafmodel::measure::measure;
//! use leafmodel::optics::ProspectD;
//! use leafmodel::species;
//!
//! // A birch leaf, smaller than usual, from a seed of our own.
//! let mut plan = species::find("birch").ok_or("the birch is a preset")?.plan();
//! plan.length_mm = 30.0;
//! plan.seed = 2;
//! plan.map_size = 128;
//! let leaf = Leaf::grow(&plan)?;
//!
//! // The flat leaf: a margin, and veins as a graph of nodes and edges.
//! let (margin, veins) = (&leaf.lamina.outline, &leaf.lamina.network);
//! assert_eq!(margin.length(), 30.0);
//! assert!(veins.loops() > 0, "a birch's veins enclose areoles");
//!
//! // What is measured on cleared leaves: mm of vein to a mm² of blade, and 40 more.
//! let measures = measure(margin, veins, plan.venation.murray_exponent());
//! let density = measures.number("vein_density_mm_per_mm2").ok_or("it has veins")?;
//! assert!((1.0..20.0).contains(&density), "{density} mm/mm²");
//!
//! // The blade in space: triangles in millimetres, with normals and texture coordinates.
//! let mesh = &leaf.mesh;
//! assert_eq!(mesh.positions.len(), mesh.normals.len());
//! assert!(mesh.triangles.len() > 1000);
//!
//! // What its tissue reflects and lets through at 550 nm, from what it holds.
//! let green = ProspectD::coefficients(550.0)?.reflectance_transmittance(&plan.tissue.lamina);
//! assert!(green.reflectance > 0.05 && green.transmittance > 0.05);
//!
//! // A drawing of it, true to size.
//! let drawing = svg(margin, veins, SvgStyle::default());
//! assert!(drawing.starts_with("<svg"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Same plan and seed, same leaf, bit for bit, on every machine and any number of threads.
//!
//! | question | where |
//! | --- | --- |
//! | a margin from an SVG file or from control points | [`shape`] |
//! | growth that a program can stop | [`grow_options`] |
//! | how veins come to be | [`venation`], [`transport`] |
//! | margin and main veins from one development | [`development`] |
//! | measures of shape and veins; networks as files for other programs, and from them | [`measure`], [`export`], [`import`] |
//! | parameters that bring forth what was measured | [`inference`] |
//! | margin and veins of a picture | [`tracing`] |
//! | the blade in space, contents over it, ageing | [`blade`] |
//! | leaflets on a rachis; fruits and caps; boughs | [`compound`], [`solid`], [`plant`] |
//! | variegation by cells that divide | [`mosaic`] |
//! | reflectance and transmittance from contents | [`optics`] |
//!
//! `leafmodel/examples` has whole programs: a leaf within one's own margin, a sweep of two
//! parameters, a network as CSV, a spectrum.

pub mod blade;
pub mod compound;
pub mod development;
pub mod export;
pub mod grow_options;
pub mod import;
pub mod leaf;
pub mod measure;
pub mod mosaic;
pub mod not_grown;
pub mod plan_file;
pub mod plant;
pub mod shape;
mod shell;
pub mod solid;
pub mod species;
pub mod tracing;
pub mod transport;
pub mod venation;

#[doc(inline)]
pub use document;
pub(crate) use numerics::{buckets, numeric, plane, random, rotation};
#[doc(inline)]
pub use numerics::{inference, memory, rest};
#[doc(inline)]
pub use optics;
