//! Blocks as tables of keys for the book, and the places in a page where they go.

use super::{BlockSchema, EntrySchema, Is, default_in_words, unit_of};

/// The table of a block's keys. Of blocks inside it only the name and meaning are told.
pub fn tables(schema: &BlockSchema) -> String {
    let mut text =
        String::from("| key | unit | allowed | default | meaning |\n|---|---|---|---|---|\n");
    for entry in &schema.entries {
        text.push_str(&row(entry));
    }
    for group in &schema.groups {
        let keys: Vec<String> = group.keys.iter().map(|key| format!("`{key}`")).collect();
        let how_many = if group.required {
            "Exactly one"
        } else {
            "At most one"
        };
        text.push_str(&format!("\n{how_many} of {} is there.\n", keys.join(", ")));
    }
    text
}

fn row(entry: &EntrySchema) -> String {
    let unit = unit_of(&entry.key).unwrap_or("–");
    let (unit, allowed, default) = match &entry.is {
        Is::Value { of, default } => {
            let default = match default {
                Some(default) => format!("`{}`", default_in_words(default)),
                None if entry.required => "required".to_owned(),
                None => "none".to_owned(),
            };
            (unit, of.in_brief(), default)
        }
        Is::Block(_) => ("–", "a block".to_owned(), usual(entry)),
        Is::Named(_) => ("–", "blocks, each under a name".to_owned(), usual(entry)),
        Is::List { most, .. } => (
            "–",
            format!("a list of at most {most} tables"),
            usual(entry),
        ),
    };
    let allowed = allowed.replace('|', "\\|");
    format!(
        "| `{}` | {unit} | {allowed} | {default} | {} |\n",
        entry.key, entry.about
    )
}

/// What stands for the default of a block.
fn usual(entry: &EntrySchema) -> String {
    if entry.required { "required" } else { "–" }.to_owned()
}

/// A page with its tables as the schema has them: each `<!-- keys: PATH -->` is followed by the
/// table of the block at that path, up to `<!-- end of keys -->`.
///
/// # Errors
///
/// The path of a marker that names no block, or that has no end.
pub fn filled(page: &str, root: &BlockSchema) -> Result<String, String> {
    const START: &str = "<!-- keys: ";
    const END: &str = "<!-- end of keys -->";
    let mut text = String::new();
    let mut rest = page;
    while let Some(start) = rest.find(START) {
        let (before, marked) = rest.split_at(start);
        let line_end = marked.find("-->").ok_or("a marker has no `-->`")?;
        let path = marked[START.len()..line_end].trim();
        let parts: Vec<&str> = path.split('.').filter(|part| !part.is_empty()).collect();
        let block = root
            .at(&parts)
            .ok_or_else(|| format!("`{path}` is no block of the schema"))?;
        let end = marked
            .find(END)
            .ok_or_else(|| format!("the table of `{path}` has no `{END}`"))?;
        text.push_str(before);
        text.push_str(&marked[..line_end + 3]);
        text.push_str("\n\n");
        text.push_str(&tables(block));
        text.push('\n');
        text.push_str(END);
        rest = &marked[end + END.len()..];
    }
    text.push_str(rest);
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keys::Keys;
    use crate::limits::Limits;
    use crate::value_kind::Number;

    #[test]
    fn a_page_gets_its_tables_and_keeps_the_rest() {
        let schema = Keys::describe(|keys| {
            keys.block("blade", "Its shape.", |keys| {
                let limits = Number(Limits::closed(0.0, 1.0));
                keys.key("fold_deg", &mut 0.5, limits, "How far it folds.");
            });
        });
        let page = "# Page\n<!-- keys: blade -->\nstale\n<!-- end of keys -->\nend\n";
        let new = filled(page, &schema).expect("the block is there");
        let row = "| `fold_deg` | ° | 0 to 1 | `0.5` | How far it folds. |";
        assert!(new.contains(row) && !new.contains("stale"), "{new}");
        assert!(new.starts_with("# Page\n") && new.ends_with("\nend\n"));
        assert_eq!(filled(&new, &schema).expect("still there"), new);
        assert!(filled("<!-- keys: bald -->\n<!-- end of keys -->", &schema).is_err());
    }
}
