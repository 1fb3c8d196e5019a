//! What needs both crates, statistics or pictures: one program, because to link one for each file
//! takes longer than to run it.

mod architecture;
mod closed_bodies;
mod compositing;
mod determinism;
mod drops;
mod fluorescence;
mod format;
mod golden;
mod instruments;
mod layers;
mod leaf_by_angle;
mod lights;
mod limits;
mod media;
mod optics;
mod positions;
mod presets;
mod provenance;
mod radiometry;
mod random_plans;
mod reported_errors;
mod scattering;
mod sensitivities;
mod sensors;
mod solid_tissue;
mod white_balance;
