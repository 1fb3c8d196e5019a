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
        let first_word = other.iter().position(|letter| ['-', '_'].contains(letter));
        let distance = match first_word {
            Some(end) if written.len() >= 4 && edit_distance(&written, &other[..end]) == 1 => {
                distance.min(2)
            }
            _ => distance,
        };
        if distance <= allowed && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// Most names that are suggested at once.
const SUGGESTED: usize = 4;

/// The names that somebody meant who wrote a word that is none of them, as a message has them between
/// backticks: those that hold the word, at their end first (`oak` is `white-oak` or `red-oak`); else
/// the one that is spelled nearly so; else those whose description has the word.
pub fn meant<'c>(
    written: &str,
    candidates: impl Iterator<Item = (&'c str, &'c str)> + Clone,
) -> Option<String> {
    let word = written.to_lowercase();
    let has = |text: &str| {
        let mut words = text.split(|letter: char| !letter.is_alphanumeric());
        words.any(|other| other.to_lowercase() == word)
    };
    let names = || candidates.clone().map(|(name, _)| name);
    let mut found: Vec<&str> = names().filter(|name| has(name)).collect();
    found.sort_by_key(|name| !name.ends_with(&word));
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
    }

    #[test]
    fn a_swap_of_neighbours_is_one_slip() {
        let letters = |text: &str| text.chars().collect::<Vec<_>>();
        assert_eq!(edit_distance(&letters("abcd"), &letters("acbd")), 1);
        assert_eq!(edit_distance(&letters("kitten"), &letters("sitting")), 3);
        assert_eq!(edit_distance(&letters(""), &letters("abc")), 3);
    }
}
