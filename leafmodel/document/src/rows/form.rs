//! How a table is written: what separates fields, and the decimal mark.

/// Lines from which the separator is found.
const SAMPLE: usize = 32;

/// What separates the fields of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Separator {
    /// A tab.
    Tab,
    /// A semicolon.
    Semicolon,
    /// A comma.
    Comma,
    /// Any number of spaces and tabs.
    Blanks,
}

/// The mark between whole numbers and decimals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Decimal {
    /// A point.
    Point,
    /// A comma.
    Comma,
}

/// What is known of how a table is written; the rest is found from it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Form {
    /// What separates fields.
    pub separator: Option<Separator>,
    /// The decimal mark.
    pub decimal: Option<Decimal>,
}

impl Decimal {
    /// Both of them with the words of flags.
    pub const ALL: [(&'static str, Self); 2] = [("point", Self::Point), ("comma", Self::Comma)];
}

impl Separator {
    /// All of them with the words of flags, the first to be tried first.
    pub const ALL: [(&'static str, Self); 4] = [
        ("tab", Self::Tab),
        ("semicolon", Self::Semicolon),
        ("comma", Self::Comma),
        ("blanks", Self::Blanks),
    ];

    pub(super) fn byte(self) -> u8 {
        match self {
            Self::Tab => b'\t',
            Self::Semicolon => b';',
            Self::Comma => b',',
            Self::Blanks => b' ',
        }
    }

    /// How many fields a line has, if this separates them.
    pub(super) fn count(self, line: &str) -> usize {
        let mut is_quoted = false;
        let mut count = 1;
        let mut was_blank = true;
        for character in line.trim().chars() {
            is_quoted ^= character == '"';
            let is_blank = character.is_whitespace();
            count += match self {
                _ if is_quoted => 0,
                Self::Blanks => usize::from(is_blank && !was_blank),
                Self::Tab | Self::Semicolon | Self::Comma => {
                    usize::from(character == char::from(self.byte()))
                }
            };
            was_blank = is_blank;
        }
        count
    }

    /// Whether a field between these has several numbers with blanks between them, as commas of
    /// `400,0  0,05` leave.
    fn leaves_numbers(self, line: &str) -> bool {
        let are_numbers = |field: &str| {
            let mut words = field.split_whitespace();
            words.clone().count() > 1 && words.all(|word| parsed(word).is_some())
        };
        self != Self::Blanks && line.split(char::from(self.byte())).any(are_numbers)
    }

    /// What separates the fields of a text: the first that gives its first lines as many fields
    /// each, or else the one that the first line has most of.
    pub fn of(text: &str) -> Self {
        Self::with_rival(text).0
    }

    /// What separates the fields of a text, and what might as well, if anything does: another mark
    /// that the first line has, and all lines equally often if that is what the choice rests on. Blanks
    /// are no rival, because they are part of names.
    pub(super) fn with_rival(text: &str) -> (Self, Option<Self>) {
        let lines = text.split(['\n', '\r']).map(str::trim);
        let lines = lines.filter(|line| !line.is_empty() && !line.starts_with('#'));
        let lines: Vec<&str> = lines.take(SAMPLE).collect();
        let Some((first, rest)) = lines.split_first() else {
            return (Self::Comma, None);
        };
        let is_even = |separator: &Self| {
            let count = separator.count(first);
            let is_same = |line: &&str| separator.count(line) == count;
            count > 1
                && rest.iter().all(is_same)
                && !lines.iter().any(|line| separator.leaves_numbers(line))
        };
        let all = Self::ALL.map(|(_, separator)| separator);
        let marks = || all.into_iter().filter(|mark| *mark != Self::Blanks);
        if let Some(even) = all.into_iter().find(is_even) {
            let rival = marks().find(|mark| *mark != even && is_even(mark));
            return (even, rival);
        }
        // Blanks are often part of names. The last of equals is taken, so that the comma wins.
        let is_there = |separator: &Self| separator.count(first) > 1;
        let most = marks().max_by_key(|separator| separator.count(first));
        if let Some(most) = most.filter(is_there) {
            let rival = marks().find(|mark| *mark != most && is_there(mark));
            return (most, rival);
        }
        let has_blanks = is_there(&Self::Blanks) && !rest.is_empty();
        let found = if has_blanks {
            Self::Blanks
        } else {
            Self::Comma
        };
        (found, None)
    }

    /// Its word in flags.
    pub(super) fn word(self) -> &'static str {
        let known = Self::ALL.iter().find(|(_, separator)| *separator == self);
        known.map_or("", |(word, _)| word)
    }
}

/// The number that a text is, with a decimal point or comma.
pub fn number(text: &str) -> Option<f64> {
    parsed(text).map(|found| found.0)
}

/// The number that a field holds, and whether it has a decimal comma.
pub(super) fn parsed(text: &str) -> Option<(f64, bool)> {
    if let Ok(number) = text.parse() {
        return Some((number, false));
    }
    let (whole, decimals) = text.split_once(',')?;
    let is_digit = |digit: Option<&u8>| digit.is_some_and(u8::is_ascii_digit);
    let is_number = is_digit(decimals.as_bytes().first())
        && (whole.is_empty() || is_digit(whole.as_bytes().last()));
    let number = format!("{whole}.{decimals}").parse().ok();
    Some((number.filter(|_| is_number)?, true))
}
