//! The page that a report is: one file with its own style, without a script.

use crate::checkpoint::PROGRAM;
use crate::plot::escaped;

/// Hues of groups on white and on black, told apart by colour-blind eyes too (Okabe and Ito).
const HUES: [(&str, &str); 7] = [
    ("#0072b2", "#56a9e4"),
    ("#d55e00", "#f08a3c"),
    ("#009e73", "#35c49a"),
    ("#b0609a", "#dd9cc6"),
    ("#a37a00", "#e8b83a"),
    ("#2b8fc4", "#8fd0f2"),
    ("#666666", "#aaaaaa"),
];

const STYLE: &str = "\
body{font:15px/1.5 system-ui,sans-serif;max-width:1480px;margin:2rem auto;padding:0 1rem;\
background:var(--paper);color:var(--ink)}\
h1{font-size:1.7rem;line-height:1.2;margin:0 0 .3rem}h2{font-size:1.25rem;margin:2.2rem 0 .6rem;\
border-bottom:1px solid var(--rule);padding-bottom:.2rem}h3{font-size:1rem;margin:0 0 .2rem;\
overflow-wrap:anywhere}\
p{margin:.4rem 0;max-width:75ch}a{color:var(--link)}code{font-size:.92em}\
.soft{color:var(--soft)}.small{font-size:.87rem}\
.wide{overflow-x:auto}table{border-collapse:collapse;font-size:.8rem;\
font-variant-numeric:tabular-nums}\
th,td{padding:.2rem .4rem;text-align:right;white-space:nowrap;border-bottom:1px solid var(--rule)}\
th{text-align:right;vertical-align:bottom;font-weight:600}\
th:first-child,td:first-child,.names :is(th,td):nth-child(-n+3){text-align:left}\
tr.sure td{font-weight:600}\
.wide td:first-child{position:sticky;left:0;background:var(--paper)}\
figure{margin:.8rem 0}figcaption{font-size:.87rem;color:var(--soft);max-width:75ch}\
svg{display:block;max-width:100%;height:auto;font:11px system-ui,sans-serif}svg text{fill:var(--ink)}\
svg text.soft{fill:var(--soft)}svg a{text-decoration:none}svg a:hover text{text-decoration:underline}\
.axis{stroke:var(--soft);stroke-width:1}.grid{stroke:var(--rule);stroke-width:1}\
.band{fill:var(--band)}.paper{fill:var(--paper)}\
.cards{display:grid;grid-template-columns:repeat(auto-fill,minmax(480px,1fr));gap:1rem}\
.card{border:1px solid var(--rule);border-radius:6px;padding:.7rem .8rem;break-inside:avoid;\
min-width:0}\
.card:target{outline:2px solid var(--link)}\
.over{mix-blend-mode:var(--blend)}.key{display:inline-block;width:.8em;height:.8em;\
border-radius:2px;margin-right:.35em;vertical-align:-.05em}\
nav{columns:3 15rem;font-size:.87rem}nav a{display:block;overflow-wrap:anywhere}\
@media(max-width:560px){.cards{grid-template-columns:1fr}}\
@media print{.key{print-color-adjust:exact;-webkit-print-color-adjust:exact}\
body{font-size:10pt;max-width:none;margin:0}nav{display:none}.wide{overflow:visible}\
table{font-size:7pt}th,td{padding:.1rem .3rem}.cards{grid-template-columns:1fr 1fr}\
h2,h3{break-after:avoid}figure,tr{break-inside:avoid}a{color:inherit;text-decoration:none}}";

/// A page with this title and body.
pub(super) fn page(title: &str, body: &str) -> String {
    let (light, dark) = (colours(false), colours(true));
    let style = STYLE;
    let kinds: String = (0..HUES.len())
        .map(|hue| {
            format!(
                ".f{hue}{{fill:var(--c{hue})}}.s{hue}{{stroke:var(--c{hue})}}\
                 .b{hue}{{background:var(--c{hue})}}"
            )
        })
        .collect();
    let title = escaped(title);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n\
         <meta name=\"generator\" content=\"Lamina {PROGRAM}\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<title>{title}</title>\n<style>\n\
         :root{{{light}}}\n@media screen and (prefers-color-scheme:dark){{:root{{{dark}}}}}\n\
         {style}{kinds}\n</style>\n</head>\n<body>\n{body}</body>\n</html>\n"
    )
}

/// The variables of the style.
fn colours(is_dark: bool) -> String {
    let base = if is_dark {
        "--paper:#16181a;--ink:#e8e8e6;--soft:#a3a7aa;--rule:#3a3e42;--band:#1e2124;--link:#7db8e8;\
         --blend:screen"
    } else {
        "--paper:#fff;--ink:#1c1e1f;--soft:#5c6166;--rule:#dcdfe2;--band:#f5f6f7;--link:#0b5c99;\
         --blend:multiply"
    };
    let hues = HUES.iter().enumerate().map(|(number, (light, dark))| {
        format!(";--c{number}:{}", if is_dark { dark } else { light })
    });
    std::iter::once(base.to_owned()).chain(hues).collect()
}

/// The hue of a group, by number.
pub(super) fn hue(group: usize) -> usize {
    group % HUES.len()
}

/// A table of cells that are HTML already; the first row heads it. What goes before it, and rows to
/// be set in bold.
pub(super) fn table(before: &str, class: &str, rows: &[Vec<String>], sure: &[bool]) -> String {
    let mut text = String::new();
    if !before.is_empty() {
        text += &format!("<p class=\"soft small\">{before}</p>\n");
    }
    text += &format!("<div class=\"wide\"><table class=\"{class}\">\n");
    for (number, row) in rows.iter().enumerate() {
        let (open, close) = match number {
            0 => ("<thead><tr>", "</tr></thead>\n<tbody>\n"),
            _ if sure.get(number - 1) == Some(&true) => ("<tr class=\"sure\">", "</tr>\n"),
            _ => ("<tr>", "</tr>\n"),
        };
        let tag = if number == 0 { "th" } else { "td" };
        text += open;
        for cell in row {
            text += &format!("<{tag}>{cell}</{tag}>");
        }
        text += close;
    }
    text + "</tbody></table></div>\n"
}

/// A figure with a caption that is HTML already.
pub(super) fn figure(svg: &str, caption: &str) -> String {
    if caption.is_empty() {
        return format!("<figure>\n{svg}</figure>\n");
    }
    format!("<figure>\n{svg}<figcaption>{caption}</figcaption>\n</figure>\n")
}

/// A name as the anchor of a place in the page: letters, digits and signs between them.
pub(super) fn anchor(key: &str, part: Option<usize>) -> String {
    let part = part.map_or_else(String::new, |part| format!("-{part}"));
    format!("{key}{part}")
}
