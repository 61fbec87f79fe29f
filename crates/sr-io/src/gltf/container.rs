//! The outer layer: plain JSON, or JSON and one binary chunk in a `.glb` (§4 of the specification).

use crate::report::Report;
use gltf::json::Root;
use sr_scene::diagnostics::Diagnostic;

const MAGIC: &[u8] = b"glTF";
const JSON: &[u8] = b"JSON";
const BIN: &[u8] = b"BIN\0";

/// The document, not validated, and the binary chunk when there is one.
pub(super) fn open<'a>(bytes: &'a [u8], report: &mut Report) -> Option<(Root, Option<&'a [u8]>)> {
    if !bytes.starts_with(MAGIC) {
        return Some((parse(bytes, true, report)?, None));
    }
    match split(bytes) {
        Ok((json, chunk)) => Some((parse(json, false, report)?, chunk)),
        Err(why) => {
            report.error(Diagnostic::error(why));
            None
        }
    }
}

fn parse(json: &[u8], is_text_file: bool, report: &mut Report) -> Option<Root> {
    let text = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json);
    match Root::from_slice(text) {
        Ok(root) => Some(root),
        Err(e) => {
            let place = format!(" at line {} column {}", e.line(), e.column());
            let message = e.to_string();
            let what = message.strip_suffix(&place).unwrap_or(&message);
            let d = Diagnostic::error(format!("not a valid glTF document: {what}"));
            let number = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
            // Lines inside a binary file help nobody.
            let span = (is_text_file && e.line() > 0)
                .then(|| report.span(number(e.line()), number(e.column()).max(1)));
            report.error(d.at(span));
            None
        }
    }
}

/// The JSON and the binary chunk of a `.glb`; chunks of other types are skipped, as §4.4 asks.
fn split(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), String> {
    let word = |at: usize| -> Option<u32> {
        let b = bytes.get(at..at.checked_add(4)?)?;
        Some(u32::from_le_bytes(b.try_into().ok()?))
    };
    let version = word(4).ok_or("the header of the binary glTF is cut short")?;
    if version != 2 {
        return Err(format!(
            "binary glTF of version {version}, only version 2 can be read"
        ));
    }
    let length = word(8).ok_or("the header of the binary glTF is cut short")? as usize;
    if length > bytes.len() {
        let have = bytes.len();
        return Err(format!(
            "the file is cut short: {have} of {length} bytes are there"
        ));
    }
    let mut chunks = Vec::with_capacity(2);
    let mut at = 12;
    while at < length && chunks.len() < 2 {
        let cut = || format!("the chunk at byte {at} is cut short");
        let size = word(at).ok_or_else(cut)? as usize;
        let end = (at + 8)
            .checked_add(size)
            .filter(|e| *e <= length)
            .ok_or_else(cut)?;
        chunks.push((&bytes[at + 4..at + 8], &bytes[at + 8..end]));
        at = end;
    }
    let (kind, json) = chunks.first().ok_or("the binary glTF has no chunks")?;
    if *kind != JSON {
        return Err("the first chunk of the binary glTF is not JSON".into());
    }
    let chunk = chunks.get(1).filter(|(kind, _)| *kind == BIN).map(|c| c.1);
    Ok((trim_padding(json), chunk))
}

/// Chunks are padded with spaces; some exporters write zeros.
fn trim_padding(mut json: &[u8]) -> &[u8] {
    while let [rest @ .., 0 | b' '] = json {
        json = rest;
    }
    json
}
