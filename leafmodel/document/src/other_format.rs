//! Lines that are written as another format has them.

use toml::de::DeTable;

use super::context::QUOTED;
use super::source::escaped;

/// A line of another format, `key: value`, as TOML has it; safe to print.
pub(super) fn with_equals(line: &str) -> Option<String> {
    let (key, value) = line.split_once(':')?;
    let key = key.trim().trim_matches('"');
    let value = value.trim().trim_end_matches(',');
    let is_key = |letter: char| letter.is_ascii_alphanumeric() || "_-.".contains(letter);
    let is_one = !key.is_empty() && key.chars().all(is_key) && !value.is_empty();
    let is_toml = |text: &String| DeTable::parse_recoverable(text).1.is_empty();
    let mut meant = [format!("{key} = {value}"), format!("{key} = \"{value}\"")].into_iter();
    let meant = meant.find(is_toml).filter(|_| is_one)?;
    Some(escaped(&meant, QUOTED))
}
