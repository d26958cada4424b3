//! The report as a page in one file: its Markdown with the figures in it.

use maud::{DOCTYPE, PreEscaped, html};
use pulldown_cmark::{CowStr, Event, Options, Parser, Tag, TagEnd};

const STYLE: &str = "body{font:16px/1.55 system-ui,sans-serif;max-width:62rem;margin:2rem auto;padding:0 1rem;color:#1c1c1c}\
h1,h2,h3{font-weight:600;line-height:1.25}table{border-collapse:collapse;margin:1rem 0}th,td{padding:.3rem .7rem;\
border-bottom:1px solid #ddd;vertical-align:top;font-variant-numeric:tabular-nums}svg{max-width:100%;height:auto}code{font-size:13px}\
blockquote{margin:1rem 0;padding:0 1rem;border-left:3px solid #ccc;color:#444}";

/// Makes the page. An image is replaced by the figure of that file name; `figures` are SVG of the program's own.
pub(super) fn page(markdown: &str, figures: &[(String, String)]) -> String {
    let mut image = None;
    let mut clips = 0;
    let events = Parser::new_ext(markdown, Options::ENABLE_TABLES).filter_map(|event| match event {
        Event::Start(Tag::Image { dest_url, .. }) => {
            image = Some(dest_url);
            None
        }
        Event::End(TagEnd::Image) => {
            let name = image.take()?;
            let (_, svg) = figures.iter().find(|(file, _)| **file == *name)?;
            // Identifiers are one figure's own in a file, but have to differ on a page.
            clips += 1;
            let svg = svg.replace("plot-", &format!("figure-{clips}-plot-"));
            Some(Event::InlineHtml(CowStr::from(svg)))
        }
        // The text of an image stands for it where it cannot be shown.
        _ if image.is_some() => None,
        other => Some(other),
    });
    let mut body = String::new();
    pulldown_cmark::html::push_html(&mut body, events);
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                title { "Axiscope: reproduction of Li et al. 2018" }
                style { (PreEscaped(STYLE)) }
            }
            body { (PreEscaped(body)) }
        }
    };
    page.into_string()
}
