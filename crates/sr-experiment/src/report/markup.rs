//! Text for HTML.

/// Text as it reads, in and out of attributes.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            // HTML has no place for these, escaped or not.
            c if c.is_control() && !matches!(c, '\n' | '\t') => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

/// A section with a heading, and a name that links can lead to.
pub fn section(id: &str, heading: &str, body: &str) -> String {
    format!(
        "<section id=\"{id}\">\n<h2>{}</h2>\n{body}</section>\n",
        escape(heading)
    )
}

/// A file inside of a page.
pub fn data_uri(mime: &str, bytes: &[u8]) -> String {
    use base64::Engine;
    let text = base64::engine::general_purpose::STANDARD.encode(bytes);
    format!("data:{mime};base64,{text}")
}

/// JSON inside of a page: nothing in it can end the element that holds it.
pub fn json(value: &impl serde::Serialize) -> Result<String, String> {
    let text = serde_json::to_string(value).map_err(|e| format!("cannot write JSON: {e}"))?;
    // In JSON `<` stands in strings only, where this is the same letter.
    Ok(text.replace('<', "\\u003c"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_cannot_become_markup() {
        assert_eq!(
            escape("<img src=x onerror='a()'> & \"q\"\u{1b}"),
            "&lt;img src=x onerror=&#39;a()&#39;&gt; &amp; &quot;q&quot;\u{fffd}"
        );
    }

    #[test]
    fn json_cannot_end_its_element_and_stays_the_same_json() {
        let wanted = "</script><!--";
        let text = json(&wanted).unwrap();
        assert!(!text.contains('<'), "{text}");
        assert_eq!(serde_json::from_str::<String>(&text).unwrap(), wanted);
    }
}
