//! Which measures parameters of growth are fitted to unless others are named, and which are held
//! out to test the fit.
//!
//! None of them depends on the size of the blade, so a leaf and its simulations may differ a little
//! in area; none is a function of another. Lists are left out: their numbers go together.

/// Measures that are fitted.
pub const FITTED: [&str; 15] = [
    "vein_density_mm_per_mm2",
    "minor_vein_share",
    "vein_distance_mm_mean",
    "vein_distance_mm_median",
    "areoles_per_mm2",
    "areole_area_mm2_median",
    "areole_area_cv",
    "freely_ending_veinlets_per_mm2",
    "freely_ending_veinlet_length_mm_mean",
    "junction_degree_3_share",
    "junction_largest_angle_deg_median",
    "branching_fine_deflection_deg_median",
    "loop_nesting",
    "secondary_spacing_mm_mean",
    "tertiary_angle_deg_mean",
];

/// Measures that the fit does not see: the form of areoles, forks and the tree within the net.
pub const HELD_OUT: [&str; 4] = [
    "areole_circularity_median",
    "areole_elongation_median",
    "branching_angle_deg_median",
    "spanning_tree_ratio",
];
