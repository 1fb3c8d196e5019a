//! Figures as charts: spectra, planes of view angles, and depth.

use crate::instruments::{Row, ViewAngles};
use crate::plot::{CHART_SIZE, Canvas, Chart, ChartLine};

/// Charts of a file; more would be a book.
const MOST_CHARTS: usize = 24;

/// What the x axis of a chart is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Over {
    Wavelength,
    Zenith,
    Depth,
}

impl Over {
    fn label(self) -> &'static str {
        match self {
            Self::Wavelength => "wavelength, nm",
            Self::Zenith => "view zenith angle, °; positive on the side of the light at azimuth 0",
            Self::Depth => "distance from the adaxial face, µm",
        }
    }

    /// How a row is drawn; `None` if it is not.
    fn of(row: &Row) -> Option<Self> {
        if row.band.is_some() {
            return None;
        }
        row.wavelength_nm?;
        match (row.view, row.depth_um) {
            (Some(_), _) => Some(Self::Zenith),
            (None, Some(_)) => Some(Self::Depth),
            (None, None) => Some(Self::Wavelength),
        }
    }

    fn place(self, row: &Row) -> Option<f64> {
        match self {
            Self::Wavelength => row.wavelength_nm,
            Self::Zenith => row.view.map(|view| view.degrees()[0]),
            Self::Depth => row.depth_um,
        }
    }
}

/// What a row is besides its place on the x axis, in words for a legend.
fn label(row: &Row, over: Over) -> String {
    let mut words = Vec::new();
    if over == Over::Wavelength {
        words.push(row.quantity.to_owned());
        words.extend(row.part.clone());
    }
    words.extend(row.face.map(str::to_owned));
    let light = row.incidence.to_string();
    words.push(if light == "diffuse" {
        light
    } else {
        format!("at {light}°")
    });
    if over != Over::Wavelength {
        words.extend(row.wavelength_nm.map(|nm| format!("{nm} nm")));
    }
    if let Some([_, azimuth]) = row.view.as_ref().map(ViewAngles::degrees) {
        words.push(format!("azimuth {azimuth}°"));
    }
    words.join(", ")
}

/// The charts of all rows: one for each instrument and x axis, by quantity where that is no
/// wavelength. Figures of bands, and those of a single wavelength by wavelength, are not drawn.
fn charts(rows: &[Row]) -> Vec<Chart> {
    let mut charts: Vec<(String, Over, Chart)> = Vec::new();
    for row in rows {
        let Some(over) = Over::of(row) else {
            continue;
        };
        let Some(x) = over.place(row) else {
            continue;
        };
        let (title, unit) = match over {
            Over::Wavelength => (format!("{}, by wavelength", row.instrument), row.unit),
            Over::Zenith | Over::Depth => {
                (format!("{}: {}", row.instrument, row.quantity), row.unit)
            }
        };
        let key = format!("{title} {unit}");
        let place = charts
            .iter()
            .position(|(known, drawn, _)| *known == key && *drawn == over)
            .unwrap_or_else(|| {
                let y = match unit {
                    "1" => "share or factor".to_owned(),
                    unit => unit.to_owned(),
                };
                let chart = Chart {
                    title: title.clone(),
                    axes: [over.label().to_owned(), y],
                    lines: Vec::new(),
                };
                charts.push((key.clone(), over, chart));
                charts.len() - 1
            });
        let lines = &mut charts[place].2.lines;
        let label = label(row, over);
        let point = [x, row.value, row.error];
        match lines.iter_mut().find(|line| line.label == label) {
            Some(line) => line.points.push(point),
            None => lines.push(ChartLine {
                label,
                points: vec![point],
            }),
        }
    }
    let mut charts: Vec<Chart> = charts.into_iter().map(|(_, _, chart)| chart).collect();
    for chart in &mut charts {
        chart.lines.retain(|line| line.points.len() > 1);
    }
    charts.retain(|chart| !chart.lines.is_empty());
    charts
}

/// A file with all charts below each other; `None` if there is nothing to draw a line through.
pub(crate) fn svg(rows: &[Row]) -> Option<String> {
    let charts = charts(rows);
    let drawn = &charts[..charts.len().min(MOST_CHARTS)];
    if drawn.is_empty() {
        return None;
    }
    let [width, height] = CHART_SIZE;
    let mut canvas = Canvas::new([width, height * drawn.len() as f64]);
    for (number, chart) in drawn.iter().enumerate() {
        canvas.shifted([0.0, height * number as f64], |canvas| chart.draw(canvas));
    }
    Some(canvas.file())
}
