//! How leaves afloat in a box, or those of a medium, are inclined: `inclination`, with the numbers that some distributions have.

use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::value_kind::{Number, Numbers, Word};

use crate::geometry::scatter::{Inclination, InclinationTable};
use crate::scene::blocks::number_rows::NumberRows;

/// Words for distributions; numbers that the last three need are read beside.
static WORDS: [(&str, Inclination); 9] = [
    ("spherical", Inclination::Spherical),
    ("uniform", Inclination::Uniform),
    ("planophile", Inclination::Planophile),
    ("erectophile", Inclination::Erectophile),
    ("plagiophile", Inclination::Plagiophile),
    ("extremophile", Inclination::Extremophile),
    ("beta", Inclination::Beta { mu: 1.0, nu: 1.0 }),
    ("ellipsoidal", Inclination::Ellipsoidal { chi: 1.0 }),
    ("table", Inclination::Table(InclinationTable::NONE)),
];

/// Words that need a key, the key, and what a message shows.
const NEEDS: [[&str; 3]; 3] = [
    [
        "beta",
        "beta",
        "`inclination = \"beta\"`, `beta = [2.77, 1.172]`",
    ],
    [
        "ellipsoidal",
        "chi",
        "`inclination = \"ellipsoidal\"`, `chi = 1.5`",
    ],
    [
        "table",
        "inclinations",
        "`inclination = \"table\"`, `inclinations = { table = [[0, 0.2], [90, 1]] }`",
    ],
];

/// The rows of a table.
const ROWS: NumberRows<2> = NumberRows {
    columns: ["inclination_deg", "density"],
    least: 2,
    limits: Limits::closed(0.0, f64::MAX),
    wanted: "a list of [inclination in degrees, density]",
    about: [
        "The rows, whose inclinations rise from 0 to 90.",
        "Such rows in a file with the columns `inclination_deg` and `density`.",
    ],
    help: "write the names `inclination_deg` and `density`, and two numbers in each line below",
};

pub(in crate::scene) fn declare(own: &mut Inclination, keys: &mut Keys<'_>) {
    let (mut beta, mut chi, mut rows) = (None, None, None);
    match own {
        Inclination::Beta { mu, nu } => beta = Some([*mu, *nu]),
        Inclination::Ellipsoidal { chi: own } => chi = Some(*own),
        Inclination::Table(table) => rows = Some(table.points().to_vec()),
        Inclination::Spherical
        | Inclination::Uniform
        | Inclination::Planophile
        | Inclination::Erectophile
        | Inclination::Plagiophile
        | Inclination::Extremophile => {}
    }
    let is_of_kind = |(_, kind): &&(&str, Inclination)| {
        std::mem::discriminant(kind) == std::mem::discriminant(own)
    };
    let word = WORDS.iter().find(is_of_kind);
    let mut kind = word.map_or(Inclination::Spherical, |(_, kind)| kind.clone());
    let about = "The distribution of the angle between their normals and the vertical: after de Wit, a Beta \
        distribution, an ellipsoidal one, or a table.";
    keys.key("inclination", &mut kind, Word(&WORDS), about);
    let about = "µ and ν of the Beta distribution (Goel and Strebel): density (1 − t)^(µ−1) \
        t^(ν−1) of t, the angle over 90°.";
    let limits = Numbers::<2>(Limits::closed(0.1, 1000.0));
    keys.optional("beta", &mut beta, limits, about);
    let about = "χ of the ellipsoidal distribution (Campbell): horizontal over vertical axis of the ellipsoid as \
        whose surface leaves are inclined. 1 is spherical, greater is more level.";
    keys.optional("chi", &mut chi, Number(Limits::closed(0.01, 100.0)), about);
    let about =
        "Densities of leaf area by inclination, linear between rows and 0 outside, in any unit.";
    keys.optional_block("inclinations", &mut rows, Vec::new, about, |rows, keys| {
        ROWS.declare(rows, keys);
    });
    if !keys.is_sound() {
        return;
    }
    let there = [beta.is_some(), chi.is_some(), rows.is_some()];
    let word = WORDS.iter().find(|(_, own)| *own == kind);
    let word = word.map_or("", |(word, _)| word);
    for ([of, key, example], is_there) in NEEDS.into_iter().zip(there) {
        if (word == of) != is_there {
            let problem = format!("`inclination = \"{of}\"` and `{key}` belong together");
            keys.refuse(&["inclination"], problem, &format!("write both: {example}"));
            return;
        }
    }
    *own = match (beta, chi, rows) {
        (Some([mu, nu]), ..) => Inclination::Beta { mu, nu },
        (None, Some(chi), _) => Inclination::Ellipsoidal { chi },
        (None, None, Some(rows)) => match InclinationTable::new(rows) {
            Ok(table) => Inclination::Table(table),
            Err(problem) => {
                let help =
                    "write rows of an inclination in degrees, rising from 0 to 90, and a density";
                return keys.refuse(&["inclinations"], problem.to_string(), help);
            }
        },
        (None, None, None) => kind,
    };
}
