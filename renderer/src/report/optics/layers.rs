//! The leaf as five layers: both faces by wavelength, and what each layer absorbs.

use std::fmt::Write as _;

use leafmodel::optics::layers::{Cells, Faces, LayeredLeaf, Resolution, Tissue};
use leafmodel::optics::{Contents, ProspectD};
use rayon::prelude::*;

use crate::bsdf::leaf::usual_abaxial_ratio;
use crate::checkpoint::PROGRAM;
use crate::report::table::in_columns;
use crate::spectrum::Lanes;

/// Wavelengths, nm, at which the faces of broad leaves were compared by measurement.
const COMPARED_NM: [f64; 4] = [450.0, 550.0, 680.0, 800.0];

/// Both faces at every nanometre of PROSPECT-D's table; a comment says what wrote it, of which leaf.
pub(crate) fn table(contents: &Contents, line: &str) -> String {
    let leaf = LayeredLeaf::new(contents);
    let mut table = format!("# Lamina {PROGRAM}, leaf of layers: {line}\nwavelength_nm");
    for column in ["R_adaxial", "T_adaxial", "R_abaxial", "T_abaxial"] {
        table += &format!(",{column}");
    }
    table += ",R_diffuse_adaxial,R_diffuse_abaxial,T_diffuse";
    for face in ["adaxial", "abaxial"] {
        for tissue in Tissue::ALL {
            table += &format!(",A_{}_lit_{face}", tissue.name());
        }
    }
    table.push('\n');
    let wavelengths: Vec<u32> = (400..=2500).collect();
    let rows: Vec<String> = wavelengths
        .into_par_iter()
        .map(|nm| row(&leaf, nm))
        .collect();
    table + &rows.concat()
}

fn row(leaf: &LayeredLeaf, nm: u32) -> String {
    let at = ProspectD::coefficients_extrapolated(f64::from(nm));
    let Faces {
        normal: [adaxial, abaxial],
        diffuse: [diffuse_adaxial, diffuse_abaxial],
    } = leaf.faces(&at, Resolution::FAST);
    let mut row = nm.to_string();
    let shares = [
        adaxial.reflected,
        adaxial.transmitted,
        abaxial.reflected,
        abaxial.transmitted,
        diffuse_adaxial.reflected,
        diffuse_abaxial.reflected,
        diffuse_adaxial.transmitted,
    ];
    for share in shares
        .iter()
        .chain(&adaxial.absorbed)
        .chain(&abaxial.absorbed)
    {
        // Writing to a String cannot fail.
        let _ = write!(row, ",{share:.9}");
    }
    row.push('\n');
    row
}

/// Both faces at a few wavelengths, beside the plate model of the same contents and the rule by
/// which a scene finds the abaxial face.
pub(crate) fn faces(contents: &Contents) -> String {
    let leaf = LayeredLeaf::new(contents);
    let head = [
        "nm",
        "R adaxial",
        "R abaxial",
        "abaxial/adaxial",
        "by scenes' rule",
        "T",
        "R plates",
        "T plates",
    ];
    let rows = COMPARED_NM.map(|nm| {
        let at = ProspectD::coefficients_extrapolated(nm);
        let faces = leaf.faces(&at, Resolution::FAST);
        let [adaxial, abaxial] = faces.normal;
        let plates = at.reflectance_transmittance(contents);
        let lane = |share: f64| Lanes::<1>([share as f32]);
        let rule = usual_abaxial_ratio(lane(plates.reflectance), lane(plates.transmittance));
        let figures = [
            adaxial.reflected,
            abaxial.reflected,
            abaxial.reflected / adaxial.reflected,
            f64::from(rule.0[0]),
            adaxial.transmitted,
            plates.reflectance,
            plates.transmittance,
        ];
        let mut cells = figures.map(|figure| format!("{figure:.3}")).into_iter();
        std::array::from_fn(|column| match column {
            0 => nm.to_string(),
            _ => cells.next().expect("there is a figure for each column"),
        })
    });
    let cells = match leaf.cells() {
        Cells::Full => "full of water",
        Cells::Empty => "empty",
    };
    let thickness = leaf.thickness_um();
    format!(
        "{thickness:.0} µm thick, cells {cells}\n{}",
        in_columns(head, rows)
    )
}
