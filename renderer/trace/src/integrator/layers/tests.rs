use super::*;
use crate::film::FEATURE_SAMPLES;
use crate::spectrum::recorded::Band;

/// A film of each kind.
fn kinds() -> [FilmKind; 2] {
    let range_nm = [400.0, 780.0];
    let bands = [450.0, 550.5, 900.0].map(|center_nm| Band {
        center_nm,
        width_nm: 10.0,
    });
    let bands = bands.to_vec();
    [
        FilmKind::Rgb {
            range_nm,
            observer: crate::spectrum::observer::Observer::Cie1931,
        },
        FilmKind::Spectral { bands },
    ]
}

fn layouts() -> [(FilmKind, Layout); 2] {
    kinds().map(|kind| {
        let layout = Layout::new(&WavelengthSampler::new(&kind));
        (kind, layout)
    })
}

fn channels_of(kind: &FilmKind, layout: Layout) -> Vec<String> {
    layout
        .layers()
        .flat_map(|layer| layer.channel_names(kind))
        .collect()
}

#[test]
fn channels_have_the_names_that_other_programs_look_for() {
    let [(rgb, colour), (spectral, bands)] = layouts();
    let of_any = "A P.X P.Y P.Z N.X N.Y N.Z depth.Z samples.Y id.object";
    let of_colour = "R G B variance.R variance.G variance.B variance.Y albedo.R albedo.G albedo.B";
    let of_bands =
        "S0.450,000000nm S0.550,500000nm S0.900,000000nm variance.S0.450,000000nm albedo.Y";
    for (found, wanted) in [
        (channels_of(&rgb, colour), of_colour),
        (channels_of(&spectral, bands), of_bands),
    ] {
        for name in wanted.split(' ').chain(of_any.split(' ')) {
            assert!(found.iter().any(|other| other == name), "{name}");
        }
    }
}

#[test]
fn no_two_channels_of_a_picture_share_a_name() {
    for (kind, layout) in layouts() {
        let mut names = channels_of(&kind, layout);
        let count = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), count);
    }
}

#[test]
fn a_film_has_what_its_layers_are_made_of() {
    for (_, layout) in layouts() {
        let mut next = 0;
        for layer in layout.layers() {
            match layer.source {
                Source::Feature { .. } => {
                    assert_eq!(layout.first_feature(layer.name), Some(next));
                    next += layer.features();
                }
                Source::OfPoint { layer: point, .. } => {
                    let found = layout.layers().find(|other| other.name == point);
                    assert_eq!(found.map(FilmLayer::features), Some(3), "{point}");
                }
                Source::Radiance(_) | Source::Variance(_) | Source::Pixel(_) => {}
            }
        }
        assert_eq!(next, layout.sums().len());
        assert!(next <= MOST_FEATURES);
    }
}

#[test]
fn a_pixel_of_colour_takes_at_most_192_bytes() {
    let [(_, colour), _] = layouts();
    // The number of samples, the list of open batches, and where halves are.
    let of_its_block = 68.0 / 64.0;
    assert!(colour.bytes_per_pixel() as f64 + of_its_block <= 192.0);
}

const OUTPUT: &str = include_str!("../../../fixtures/output.md");
const PATHS: &str = include_str!("../../../fixtures/paths.md");

/// The channels of a layer as written in the book.
fn shown(layer: &FilmLayer) -> String {
    let [rgb, _] = kinds();
    let names = layer.channel_names(&rgb).join(" ");
    match (layer.channels, layer.name) {
        (Channels::Named(_), _) => format!("`{names}`"),
        (Channels::OfFilm, "") => format!("`{names}`, or `S0.<nm>nm` for each band"),
        (Channels::OfFilm, name) => format!("`{names}`, or `{name}.S0.<nm>nm` for each band"),
    }
}

/// The rows of the table of layers.
fn rows_of_layers() -> Vec<String> {
    let row = |layer: &FilmLayer| {
        let films = match layer.films {
            Films::All => "",
            Films::Colour => "; colour films",
            Films::Spectral => "; spectral films",
        };
        let samples = match layer.source {
            Source::Feature {
                sum: Sum::Wide { .. } | Sum::Narrow { .. },
                ..
            } => format!("; mean over the pixel's first {FEATURE_SAMPLES} samples"),
            Source::Feature {
                sum: Sum::First, ..
            }
            | Source::Radiance(_)
            | Source::Variance(_)
            | Source::Pixel(_)
            | Source::OfPoint { .. } => String::new(),
        };
        format!("| {} | {}{samples}{films} |", shown(layer), layer.about)
    };
    LAYERS.iter().map(row).collect()
}

/// The rows of the table of a pixel's storage for features.
fn rows_of_features() -> Vec<String> {
    let row = |layer: &FilmLayer| match layer.source {
        Source::Feature { sum, .. } => {
            let kept = match sum {
                Sum::Wide { fraction_bits } => format!(
                    "sum of each, 64 bits, in units of 2{}, rounded to the nearest",
                    minus(fraction_bits)
                ),
                Sum::Narrow { fraction_bits } => format!(
                    "sum of each, 32 bits, in units of 2{}, rounded to the nearest",
                    minus(fraction_bits)
                ),
                Sum::First => "that of sample 0, 32 bits".to_owned(),
            };
            let bytes = layer.features() * sum.bytes();
            Some(format!("| {} | {kept} | {bytes} |", shown(layer)))
        }
        Source::Radiance(_) | Source::Variance(_) | Source::Pixel(_) | Source::OfPoint { .. } => {
            None
        }
    };
    LAYERS.iter().filter_map(row).collect()
}

/// A negative exponent.
fn minus(exponent: i32) -> String {
    let raised = |digit: char| match digit.to_digit(10) {
        Some(digit) => ["⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"][digit as usize],
        None => "⁻",
    };
    (-exponent).to_string().chars().map(raised).collect()
}

#[test]
fn the_book_lists_every_layer() {
    for (page, head, rows) in [
        (
            OUTPUT,
            "| layer | what it is |\n| --- | --- |\n",
            rows_of_layers(),
        ),
        (
            PATHS,
            "| coverage | number of covered samples, and of those that record features | 4 |\n",
            rows_of_features(),
        ),
    ] {
        let table = page.split(head).nth(1).expect("the page has the table");
        let listed: Vec<&str> = table
            .lines()
            .take_while(|line| line.starts_with('|'))
            .collect();
        assert!(listed == rows, "the book should list\n{}", rows.join("\n"));
    }
    let [(_, colour), _] = layouts();
    let bytes = format!(
        "That makes {} bytes per pixel for colour.",
        colour.bytes_per_pixel()
    );
    assert!(PATHS.contains(&bytes), "{bytes}");
}
