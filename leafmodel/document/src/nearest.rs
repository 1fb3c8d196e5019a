//! The name that somebody probably meant.

/// The candidate nearest to `written`, if any is near enough to be meant.
///
/// Near is an edit distance (insertions, deletions, replacements, swaps of neighbours; letters'
/// case left out) of at most a third of the longer name, or one name being the start of the other:
/// a key without its unit is the commonest slip. Four letters or more may also be the start of a
/// name, up to a `-` or `_`, with one slip: `brich` is `birch-yellow`. The first of equally near
/// ones wins.
pub fn nearest<'c>(
    written: &str,
    candidates: impl IntoIterator<Item = &'c str>,
) -> Option<&'c str> {
    // Longer names are no typing slip, and the distance costs their product.
    const LONGEST: usize = 64;
    let written: Vec<char> = written.to_lowercase().chars().take(LONGEST + 1).collect();
    if written.len() > LONGEST {
        return None;
    }
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        let other: Vec<char> = candidate.to_lowercase().chars().take(LONGEST).collect();
        let shorter = written.len().min(other.len());
        let starts = shorter >= 3 && written[..shorter] == other[..shorter];
        let distance = edit_distance(&written, &other);
        let allowed = (written.len().max(other.len()) / 3).max(1);
        // A shared start counts as one slip, however long the unit that is missing.
        let distance = if starts { distance.min(1) } else { distance };
        let mut words = (0..other.len()).filter(|end| ['-', '_'].contains(&other[*end]));
        let is_start = |end: usize| edit_distance(&written, &other[..end]) == 1;
        let distance = if written.len() >= 4 && words.any(is_start) {
            distance.min(2)
        } else {
            distance
        };
        if distance <= allowed && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// Units of length, and how many powers of ten of a metre each is.
const LENGTHS: [(&str, i32); 6] = [
    ("km", 3),
    ("m", 0),
    ("cm", -2),
    ("mm", -3),
    ("um", -6),
    ("nm", -9),
];

/// What has to be done to the value of a key to make it that of another one, whose name differs by its
/// unit of length alone.
pub(super) fn other_unit(written: &str, meant: &str) -> Option<String> {
    let power = |unit: &str| {
        let found = LENGTHS.iter().find(|(known, _)| *known == unit);
        found.map(|(_, power)| *power)
    };
    let (stem, from) = written.rsplit_once('_')?;
    let (other, to) = meant.rsplit_once('_')?;
    let powers = power(from)? - power(to)?;
    let factor = 10_u64.pow(powers.unsigned_abs());
    let what = if powers < 0 { "divide" } else { "multiply" };
    let to = to.replace('u', "µ");
    (stem == other && powers != 0).then(|| format!("It is in {to}: {what} the value by {factor}"))
}

/// Most names that are suggested at once.
const SUGGESTED: usize = 4;

/// The names that somebody meant who wrote what is none of them, as a message has them between
/// backticks: those that hold most of its words, at their end first (`oak` is `white-oak` or
/// `red-oak`, `silver birch` is `birch` or `silver-maple`); else the one that is spelled nearly so; else
/// those whose description has the word.
pub fn meant<'c>(
    written: &str,
    candidates: impl Iterator<Item = (&'c str, &'c str)> + Clone,
) -> Option<String> {
    let word = written.to_lowercase();
    let words_of = |text: &str| -> Vec<String> {
        let words = text.split(|letter: char| !letter.is_alphanumeric());
        let words = words.filter(|word| !word.is_empty());
        words.map(str::to_lowercase).collect()
    };
    let has = |text: &str| words_of(text).contains(&word);
    let wanted = words_of(written);
    let names = || candidates.clone().map(|(name, _)| name);
    let held = |name: &str| {
        let words = words_of(name);
        wanted.iter().filter(|word| words.contains(word)).count()
    };
    let most = names().map(held).max().unwrap_or(0);
    let mut found: Vec<&str> = names()
        .filter(|name| most > 0 && held(name) == most)
        .collect();
    let last = wanted.last().map_or("", String::as_str);
    found.sort_by_key(|name| !name.ends_with(last));
    if found.is_empty() {
        found.extend(nearest(written, names()));
    }
    if found.is_empty() && word.chars().count() > 2 {
        found.extend(
            candidates
                .filter(|(_, about)| has(about))
                .map(|(name, _)| name),
        );
    }
    found.truncate(SUGGESTED);
    let (last, others) = found.split_last()?;
    Some(if others.is_empty() {
        (*last).to_owned()
    } else {
        format!("{}` or `{last}", others.join("`, `"))
    })
}

/// Edit distance with swaps of neighbours (optimal string alignment).
fn edit_distance(a: &[char], b: &[char]) -> usize {
    let width = b.len() + 1;
    let mut rows = vec![0; (a.len() + 1) * width];
    for (j, first) in rows.iter_mut().take(width).enumerate() {
        *first = j;
    }
    for i in 1..=a.len() {
        rows[i * width] = i;
        for j in 1..width {
            let replaced = rows[(i - 1) * width + j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let dropped = rows[(i - 1) * width + j] + 1;
            let added = rows[i * width + j - 1] + 1;
            let mut least = replaced.min(dropped).min(added);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                least = least.min(rows[(i - 2) * width + j - 2] + 1);
            }
            rows[i * width + j] = least;
        }
    }
    rows[a.len() * width + b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_find_the_name_that_was_meant() {
        let keys = ["position_m", "vertical_fov_deg", "up"];
        assert_eq!(nearest("positoin_m", keys), Some("position_m"));
        assert_eq!(nearest("vertical_fov", keys), Some("vertical_fov_deg"));
        assert_eq!(nearest("Position_M", keys), Some("position_m"));
        assert_eq!(nearest("colour", keys), None);
        let presets = ["birch-yellow", "oak-yellow-brown"];
        assert_eq!(nearest("brich", presets), Some("birch-yellow"));
        assert_eq!(nearest("bri", presets), None);
        let measures = ["vein_length", "vein_density_mm_per_mm2"];
        assert_eq!(nearest("vein_densty", measures), Some(measures[1]));
    }

    #[test]
    fn a_word_of_a_name_or_of_its_description_finds_all_that_have_it() {
        let presets = [
            ("oak-litter", "Dead leaves on the ground."),
            ("white-oak", "Rounded lobes."),
            ("red-oak", "Pointed lobes."),
            ("poplar", "A tree of river banks."),
        ];
        let meant = |word: &str| meant(word, presets.iter().copied());
        let oaks = "white-oak`, `red-oak` or `oak-litter";
        assert_eq!(meant("oak").as_deref(), Some(oaks));
        assert_eq!(meant("Oak").as_deref(), Some(oaks));
        assert_eq!(meant("poplr").as_deref(), Some("poplar"));
        assert_eq!(meant("lobes").as_deref(), Some("white-oak` or `red-oak"));
        assert_eq!(meant("cactus"), None);
        assert_eq!(meant("White oak").as_deref(), Some("white-oak"));
        let some = "white-oak`, `red-oak` or `oak-litter";
        assert_eq!(meant("silver oak").as_deref(), Some(some));
    }

    #[test]
    fn another_unit_of_length_is_named_with_its_factor() {
        let told = |written: &str, meant: &str| other_unit(written, meant).unwrap_or_default();
        assert_eq!(
            told("width_mm", "width_m"),
            "It is in m: divide the value by 1000"
        );
        assert_eq!(
            told("length_m", "length_mm"),
            "It is in mm: multiply the value by 1000"
        );
        assert_eq!(
            told("grain_mm", "grain_um"),
            "It is in µm: multiply the value by 1000"
        );
        assert_eq!(told("width_m", "width_m"), "");
        assert_eq!(told("widht_mm", "width_m"), "");
        assert_eq!(told("angle_rad", "angle_deg"), "");
    }

    #[test]
    fn a_swap_of_neighbours_is_one_slip() {
        let letters = |text: &str| text.chars().collect::<Vec<_>>();
        assert_eq!(edit_distance(&letters("abcd"), &letters("acbd")), 1);
        assert_eq!(edit_distance(&letters("kitten"), &letters("sitting")), 3);
        assert_eq!(edit_distance(&letters(""), &letters("abc")), 3);
    }
}
