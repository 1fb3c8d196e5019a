//! Names of columns and attributes: what each holds, and in which unit.
//!
//! Upper and lower case are the same. A unit is the end of a name (`x_mm`, `radius_um`) or stands in
//! brackets (`width (µm)`); a length without a unit is counted in the file's own units.

/// What a column or attribute of a node holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum NodeField {
    /// Its name.
    Name,
    /// A coordinate: 0 for x, 1 for y.
    Coordinate(usize, Unit),
    /// Both coordinates in one text or list.
    Place(Unit),
    /// Row and column in one text or list, as sknw has them.
    PlaceInRows(Unit),
    /// Step in which it was born.
    Born,
}

/// What a column or attribute of an edge holds. An end is 0 for the start, 1 for the end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum EdgeField {
    /// The node at an end.
    End(usize),
    /// A coordinate (0 for x, 1 for y) of an end.
    EndCoordinate(usize, usize, Unit),
    /// The radius all along.
    Radius(Unit),
    /// The radius at an end.
    EndRadius(usize, Unit),
    /// The width all along: twice the radius.
    Width(Unit),
    /// The vein order.
    Order,
    /// Its length along its course.
    Length(Unit),
    /// The same, where nodes are those of sknw.
    Weight,
    /// Points of its course.
    Course(Unit),
    /// The same by rows and columns.
    CourseInRows(Unit),
    /// What says nothing about a vein.
    Nothing,
}

/// The unit of a length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Unit {
    /// So many millimetres.
    Millimetres(f64),
    /// None is said: pixels, or units of a drawing.
    OfTheFile,
}

/// Units by the ends of names.
const UNITS: [(&str, Unit); 9] = [
    ("mm", Unit::Millimetres(1.0)),
    ("um", Unit::Millimetres(1e-3)),
    ("µm", Unit::Millimetres(1e-3)),
    ("μm", Unit::Millimetres(1e-3)),
    ("cm", Unit::Millimetres(10.0)),
    ("m", Unit::Millimetres(1e3)),
    ("px", Unit::OfTheFile),
    ("pixel", Unit::OfTheFile),
    ("pixels", Unit::OfTheFile),
];

/// A name without its unit, in lower case, and the unit.
fn parted(name: &str) -> (String, Unit) {
    let name = name.trim().to_lowercase().replace([' ', '-', '.'], "_");
    let bare = name.trim_end_matches([')', ']']);
    for (ending, unit) in UNITS {
        let rest = bare.strip_suffix(ending);
        let rest = rest.filter(|rest| rest.ends_with(['_', '(', '[']));
        if let Some(rest) = rest {
            return (rest.trim_end_matches(['_', '(', '[']).to_owned(), unit);
        }
    }
    (name, Unit::OfTheFile)
}

/// What vein orders may be.
pub(super) const ALLOWED_ORDERS: &str = "orders are whole numbers from 1 (the midrib) to 255";

impl NodeField {
    /// What a name stands for; `None` if it is not known.
    pub(super) fn of(name: &str) -> Option<Self> {
        let (name, unit) = parted(name);
        match name.as_str() {
            "id" | "node" | "name" | "label" | "number" | "node_id" => Some(Self::Name),
            "x" | "pos_x" | "x_pos" | "x_coord" => Some(Self::Coordinate(0, unit)),
            "y" | "pos_y" | "y_pos" | "y_coord" => Some(Self::Coordinate(1, unit)),
            "pos" | "position" | "place" | "xy" | "coord" | "coords" | "coordinates" => {
                Some(Self::Place(unit))
            }
            "o" => Some(Self::PlaceInRows(unit)),
            "born_step" => Some(Self::Born),
            _ => None,
        }
    }
}

impl EdgeField {
    /// What a name stands for; `None` if it is not known.
    pub(super) fn of(name: &str) -> Option<Self> {
        let (name, unit) = parted(name);
        match name.as_str() {
            "from" | "source" | "start" | "node_a" | "node_1" | "node1" | "u" | "node_id_src" => {
                Some(Self::End(0))
            }
            "to" | "target" | "end" | "node_b" | "node_2" | "node2" | "v" | "node_id_dst" => {
                Some(Self::End(1))
            }
            // As skan has them: rows, then columns.
            "coord_src_1" | "image_coord_src_1" | "from_x" | "source_x" | "start_x" | "x1" => {
                Some(Self::EndCoordinate(0, 0, unit))
            }
            "coord_src_0" | "image_coord_src_0" | "from_y" | "source_y" | "start_y" | "y1" => {
                Some(Self::EndCoordinate(0, 1, unit))
            }
            "coord_dst_1" | "image_coord_dst_1" | "to_x" | "target_x" | "end_x" | "x2" => {
                Some(Self::EndCoordinate(1, 0, unit))
            }
            "coord_dst_0" | "image_coord_dst_0" | "to_y" | "target_y" | "end_y" | "y2" => {
                Some(Self::EndCoordinate(1, 1, unit))
            }
            "radius" | "r" | "mean_radius" | "radius_mean" => Some(Self::Radius(unit)),
            // As our GeoJSON has it: the unit stands before the statistic.
            "radius_mm_mean" => Some(Self::Radius(Unit::Millimetres(1.0))),
            "radius_from" | "from_radius" => Some(Self::EndRadius(0, unit)),
            "radius_to" | "to_radius" => Some(Self::EndRadius(1, unit)),
            "width" | "diameter" | "thickness" | "mean_width" | "width_mean" | "stroke_width" => {
                Some(Self::Width(unit))
            }
            "order" | "vein_order" => Some(Self::Order),
            "length" | "len" | "branch_distance" | "arc_length" | "path_length"
            | "curve_length" | "vein_length" => Some(Self::Length(unit)),
            "weight" => Some(Self::Weight),
            "pts" => Some(Self::CourseInRows(unit)),
            "points" | "polyline" | "course" | "path" | "vertices" | "geometry" | "wkt" => {
                Some(Self::Course(unit))
            }
            "id" | "key" | "index" | "label" | "name" => Some(Self::Nothing),
            _ => None,
        }
    }
}

/// All numbers out of a text such as `[[1.5 2], [3 4]]` or `LINESTRING (1.5 2, 3 4)`; `None` if
/// anything else is in it.
pub(super) fn numbers(text: &str) -> Option<Vec<f64>> {
    let parting = |c: char| c.is_whitespace() || "()[]{},;".contains(c);
    let words = text.split(parting).filter(|word| !word.is_empty());
    let words = words.filter(|word| !word.to_ascii_uppercase().ends_with("LINESTRING"));
    words.map(|word| word.parse().ok()).collect()
}

/// Two numbers out of a text such as `(1.5, 2)`, `1.5 2` or `[1.5, 2.]`.
pub(super) fn two_numbers(text: &str) -> Option<[f64; 2]> {
    let brackets: &[char] = &['(', ')', '[', ']', '{', '}', ' '];
    let mut numbers = text
        .trim_matches(brackets)
        .split([',', ';', ' ', '\t'])
        .filter(|part| !part.is_empty());
    let mut next = || numbers.next()?.trim().parse().ok();
    let pair = [next()?, next()?];
    numbers.next().is_none().then_some(pair)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_known_with_their_units() {
        let micrometres = Unit::Millimetres(1e-3);
        let cases = [
            ("radius_um", EdgeField::Radius(micrometres)),
            ("Width (µm)", EdgeField::Width(micrometres)),
            ("diameter[px]", EdgeField::Width(Unit::OfTheFile)),
            ("stroke-width", EdgeField::Width(Unit::OfTheFile)),
            (
                "radius_from_mm",
                EdgeField::EndRadius(0, Unit::Millimetres(1.0)),
            ),
            (
                "to_y_cm",
                EdgeField::EndCoordinate(1, 1, Unit::Millimetres(10.0)),
            ),
            ("Target", EdgeField::End(1)),
        ];
        for (name, field) in cases {
            assert_eq!(EdgeField::of(name), Some(field), "{name}");
        }
        assert_eq!(
            NodeField::of("X_m"),
            Some(NodeField::Coordinate(0, Unit::Millimetres(1e3)))
        );
        // An ending that is no unit, and a name that merely ends in the letter of one.
        assert_eq!(EdgeField::of("radius_km"), None);
        assert_eq!(EdgeField::of("from"), Some(EdgeField::End(0)));
    }

    #[test]
    fn a_place_is_two_numbers_in_any_brackets() {
        for text in ["(1.5, -2)", "1.5 -2", "[1.5,-2.0]", "1.5;-2"] {
            assert_eq!(two_numbers(text), Some([1.5, -2.0]), "{text}");
        }
        for text in ["", "1", "(1, 2, 3)", "a b"] {
            assert_eq!(two_numbers(text), None, "{text}");
        }
    }
}
