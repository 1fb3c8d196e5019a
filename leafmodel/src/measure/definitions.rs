//! What each measure is, in one phrase, for tables.

/// Keys and definitions, in the order of tables.
const DEFINITIONS: [(&str, &str); 76] = [
    ("length_mm", "length of the midrib from base to tip"),
    ("width_mm", "largest width across the midrib"),
    ("width_over_length", "width over length"),
    (
        "extent_over_length",
        "extent of the margin along the midrib over length",
    ),
    (
        "widest_at",
        "height of the largest width over length, from the base",
    ),
    ("area_mm2", "area inside the margin"),
    ("perimeter_mm", "length of the margin"),
    ("circularity", "4 pi area / perimeter^2 of the margin"),
    ("solidity", "area over that of the convex hull"),
    (
        "elliptic_fourier",
        "a, b, c, d of each harmonic of the margin in turn",
    ),
    ("crossing_count", "pairs of edges that cross without a node"),
    (
        "blade_area_mm2",
        "area of the blade to which densities refer",
    ),
    ("vein_length_mm", "length of all midlines"),
    (
        "vein_density_mm_per_mm2",
        "length of all veins over the area of the blade",
    ),
    (
        "vein_density_mm_per_mm2_by_order",
        "density of each vein order; the part is the order",
    ),
    (
        "minor_vein_share",
        "share of the length in orders from 4 on",
    ),
    (
        "spanning_tree_ratio",
        "length of the minimum spanning forest over that of all veins",
    ),
    (
        "vein_distance_mm_mean",
        "distance from points of the blade to the nearest vein, mean",
    ),
    ("vein_distance_mm_mode", "the same, mode"),
    ("vein_distance_mm_median", "the same, median"),
    ("areole_count", "regions that veins enclose"),
    ("areoles_per_mm2", "areoles over the area of the blade"),
    ("areole_area_mm2_mean", "area of areoles, mean"),
    (
        "areole_area_cv",
        "standard deviation over mean of areas of areoles",
    ),
    ("areole_area_mm2_median", "area of areoles, median"),
    (
        "areole_circularity_mean",
        "4 pi area / perimeter^2 of areoles, mean",
    ),
    (
        "areole_circularity_median",
        "4 pi area / perimeter^2 of areoles, median",
    ),
    (
        "areole_elongation_median",
        "axes' ratio of the ellipse with an areole's second moments, median",
    ),
    (
        "areole_area_mm2_percentiles",
        "areas of areoles: parts are 5, 25, 50, 75 and 95 %",
    ),
    (
        "areole_circularity_percentiles",
        "circularities of areoles: parts are 5, 25, 50, 75 and 95 %",
    ),
    (
        "areole_elongation_percentiles",
        "elongations of areoles: parts are 5, 25, 50, 75 and 95 %",
    ),
    ("freely_ending_veinlet_count", "veinlets that end freely"),
    (
        "freely_ending_veinlets_per_mm2",
        "freely ending veinlets over the area of the blade",
    ),
    (
        "freely_ending_veinlets_per_areole",
        "freely ending veinlets in areoles over areoles",
    ),
    (
        "freely_ending_veinlet_length_mm_mean",
        "length of freely ending veinlets, mean",
    ),
    ("junction_count", "nodes where three or more veins meet"),
    (
        "junction_degree_3_share",
        "share of junctions where three veins meet",
    ),
    (
        "branching_angle_deg_median",
        "angle between the daughters of a fork, median",
    ),
    (
        "branching_wide_deflection_deg_median",
        "deflection of the wider daughter, median",
    ),
    (
        "branching_fine_deflection_deg_median",
        "deflection of the finer daughter, median",
    ),
    (
        "murray_ratio_median",
        "r^n of the parent over the sum of r^n of daughters, median",
    ),
    (
        "murray_exponent_median",
        "n at which that ratio is 1, median over forks",
    ),
    (
        "junction_degree_shares",
        "shares of junctions of 3, 4, and 5 or more veins",
    ),
    (
        "junction_bent_share",
        "of junctions of three like veins, share with an angle of 150 deg or more",
    ),
    (
        "junction_largest_angle_deg_median",
        "largest angle at junctions of three like veins, median",
    ),
    (
        "murray_exponent_by_order",
        "n of Murray's law, median by order of the parent",
    ),
    (
        "loop_nesting",
        "mean of smaller over larger branch in the tree of loops",
    ),
    (
        "loop_nesting_weighted",
        "the same, weighted by areoles below less one",
    ),
    ("loop_tree_strahler", "Strahler number of the tree of loops"),
    ("midrib_length_mm", "length of the midrib along its bends"),
    (
        "secondary_vein_count_left",
        "secondaries on the left of the midrib, seen from the base",
    ),
    (
        "secondary_vein_count_right",
        "secondaries on the right of the midrib, seen from the base",
    ),
    (
        "secondary_spacing_mm_mean",
        "distance between neighbouring secondaries along the midrib, mean",
    ),
    (
        "secondary_spacing_cv",
        "standard deviation over mean of that distance",
    ),
    (
        "secondary_angle_deg_mean",
        "angle between secondaries and midrib, mean",
    ),
    (
        "tertiary_angle_deg_mean",
        "angle between tertiaries and their secondary, mean",
    ),
    (
        "vein_surface_mm2",
        "surface of all veins as truncated cones",
    ),
    ("vein_volume_mm3", "volume of all veins as truncated cones"),
    (
        "vein_volume_per_area_mm",
        "volume of all veins over the area of the blade",
    ),
    (
        "loop_tree_asymmetry",
        "mean of |r - s| / (r + s - 2) in the tree of loops",
    ),
    (
        "loop_tree_depth",
        "greatest number of merges on a way through the tree of loops",
    ),
    (
        "centroid_count",
        "centroids of areoles in the window of the pair statistics",
    ),
    (
        "structure_factor_low",
        "S(k) of centroids of areoles, mean over the wavevectors of the fit",
    ),
    (
        "hyperuniformity_exponent",
        "exponent a of S(k) ~ k^a at small k",
    ),
    (
        "hyperuniformity_exponent_error",
        "standard error of that exponent",
    ),
    (
        "conductance_mm3_per_s_mpa",
        "flow through the petiole over the mean drop of pressure, each vein one pipe of its own radius, water at 20 degC",
    ),
    (
        "conductance_lost_widest_mean",
        "mean loss of conductance by a cut through one of the widest veins that cuts nothing off",
    ),
    (
        "cut_off_share_widest_mean",
        "mean share of the length of veins cut off by a cut through one of the widest veins",
    ),
    (
        "conductance_lost_by_order",
        "loss of conductance without all veins of an order, of what is still supplied",
    ),
    (
        "cut_off_share_by_order",
        "share of the length of veins cut off without all veins of an order",
    ),
    (
        "supplied_share",
        "share of the length of veins that hangs together with the petiole",
    ),
    (
        "bridge_share",
        "share of the length of veins whose cut cuts something off",
    ),
    ("order_vein_length", "length of the veins of an order"),
    ("order_vein_width", "mean width along them"),
    ("order_vein_surface", "their surface"),
    ("order_vein_volume", "their volume"),
];

/// Kinds of single values and what they are, in the order of tables.
const KINDS: [(&str, &str); 8] = [
    ("areole_area", "area of an areole"),
    (
        "areole_elongation",
        "axes' ratio of the ellipse with an areole's second moments",
    ),
    ("areole_circularity", "4 pi area / perimeter^2 of an areole"),
    (
        "vein_length",
        "length of a vein between junctions or free ends",
    ),
    ("vein_width", "mean width of a vein between junctions"),
    (
        "branch_angle",
        "deflection of a branch from the vein that leads to its junction",
    ),
    (
        "free_ending_length",
        "length of a freely ending veinlet in an areole",
    ),
    (
        "vein_distance",
        "distance from a point of the blade to the nearest vein",
    ),
];

/// Keys of measures, and of kinds of single values.
pub fn keys() -> impl Iterator<Item = &'static str> {
    DEFINITIONS.iter().chain(&KINDS).map(|(key, _)| *key)
}

/// What a measure or a kind of single values is, in one phrase; empty for a key that there is not.
pub fn definition(key: &str) -> &'static str {
    let mut all = DEFINITIONS.iter().chain(&KINDS);
    let found = all.find(|(known, _)| *known == key);
    found.map_or("", |(_, definition)| definition)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_of_measures_names_each_of_them() {
        let page = concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/measures.md");
        let page = std::fs::read_to_string(page).expect("the book is part of the repository");
        for (key, definition) in DEFINITIONS.into_iter().chain(KINDS) {
            // A row may name several by their ends: `areole_area_mm2_mean`, `_median`.
            let stem = key.rsplit_once('_').map_or(key, |(stem, _)| stem);
            let end = &key[stem.len()..];
            let together =
                page.contains(&format!("`{stem}_")) && page.contains(&format!("`{end}`"));
            let in_formula = page.contains(&format!("\\text{{{}}}", key.replace('_', "\\\\_")));
            assert!(
                page.contains(&format!("`{key}`")) || together || in_formula,
                "{key} is not on the page"
            );
            assert!(!definition.is_empty(), "{key}");
        }
    }
}
