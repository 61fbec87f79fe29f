//! Buffers: the binary chunk, `data:` URIs and files beside the document (§3.6.1).

use crate::file;
use crate::report::Report;
use base64::Engine;
use base64::alphabet;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use gltf::json::Root;
use gltf::json::buffer::Buffer;
use sr_scene::diagnostics::Diagnostic;
use std::borrow::Cow;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// Padding is optional in the wild.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &alphabet::STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// The bytes of one buffer. Buffers that name the same file share it.
#[derive(Clone, Debug)]
pub(super) enum Bytes<'a> {
    Borrowed(&'a [u8]),
    Shared(Rc<Vec<u8>>, usize),
}

impl std::ops::Deref for Bytes<'_> {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        match self {
            Self::Borrowed(b) => b,
            Self::Shared(b, length) => &b[..*length],
        }
    }
}

/// The bytes of every buffer, each as long as the document says, or `None` with all problems in
/// the report.
pub(super) fn load<'a>(
    root: &Root,
    chunk: Option<&'a [u8]>,
    document: &Path,
    report: &mut Report,
) -> Option<Vec<Bytes<'a>>> {
    let mut files = Files {
        folder: document.parent().unwrap_or(Path::new("")),
        longest: root.buffers.iter().map(length_of).max().unwrap_or(0),
        read: HashMap::new(),
    };
    let mut buffers = Vec::with_capacity(root.buffers.len());
    for (i, buffer) in root.buffers.iter().enumerate() {
        let bytes = match &buffer.uri {
            None if i == 0 => chunk
                .map(Bytes::Borrowed)
                .ok_or_else(|| "has no `uri`, and the file has no binary chunk for it".to_string()),
            None => Err("has no `uri`; only the first buffer may be the binary chunk".into()),
            Some(uri) => fetch(uri, &mut files),
        };
        let bytes = bytes.and_then(|b| cut_to_length(b, buffer));
        match bytes {
            Ok(bytes) => buffers.push(bytes),
            Err(why) => report.error(Diagnostic::error(why).field(format!("buffers[{i}]"))),
        }
    }
    (buffers.len() == root.buffers.len()).then_some(buffers)
}

fn length_of(buffer: &Buffer) -> u64 {
    buffer.byte_length.0
}

fn cut_to_length<'a>(bytes: Bytes<'a>, buffer: &Buffer) -> Result<Bytes<'a>, String> {
    let (have, want) = (bytes.len(), length_of(buffer));
    match usize::try_from(want).ok().filter(|w| *w <= have) {
        Some(length) => Ok(match bytes {
            Bytes::Borrowed(b) => Bytes::Borrowed(&b[..length]),
            Bytes::Shared(b, _) => Bytes::Shared(b, length),
        }),
        None => Err(format!("has {have} bytes, but its `byteLength` is {want}")),
    }
}

/// Files that were read already.
struct Files<'f> {
    folder: &'f Path,
    /// No buffer is longer, so no more of a file is read.
    longest: u64,
    read: HashMap<PathBuf, Rc<Vec<u8>>>,
}

impl Files<'_> {
    fn get(&mut self, relative: &Path) -> Result<Rc<Vec<u8>>, String> {
        let path = self.folder.join(relative);
        // One file under many spellings is read once.
        let key = path.canonicalize().unwrap_or_else(|_| path.clone());
        if let Some(bytes) = self.read.get(&key) {
            return Ok(bytes.clone());
        }
        let bytes = file::read_at_most(&path, self.longest)
            .map_err(|why| format!("its file `{}`: {why}", path.display()))?;
        let bytes = Rc::new(bytes);
        self.read.insert(key, bytes.clone());
        Ok(bytes)
    }
}

fn fetch<'a>(uri: &str, files: &mut Files<'_>) -> Result<Bytes<'a>, String> {
    let bytes = match strip_scheme(uri, "data:") {
        Some(data) => Rc::new(decode_data(data)?),
        None => files.get(&relative_path(uri)?)?,
    };
    let length = bytes.len();
    Ok(Bytes::Shared(bytes, length))
}

fn strip_scheme<'u>(uri: &'u str, scheme: &str) -> Option<&'u str> {
    let head = uri.get(..scheme.len())?;
    head.eq_ignore_ascii_case(scheme)
        .then(|| &uri[scheme.len()..])
}

/// `[<media type>];base64,<data>` (RFC 2397); the specification allows no other encoding.
fn decode_data(data: &str) -> Result<Vec<u8>, String> {
    let (head, body) = data.split_once(',').ok_or("its data URI has no comma")?;
    let is_base64 = head
        .rsplit(';')
        .next()
        .is_some_and(|e| e.eq_ignore_ascii_case("base64"));
    if !is_base64 {
        return Err("its data URI is not base64".into());
    }
    let body = percent_decode(body)?;
    BASE64
        .decode(body.as_ref())
        .map_err(|e| format!("its data URI is not valid base64: {e}"))
}

/// A path relative to the document. Anything with a scheme or a root is refused (§2.8: relative
/// paths; other forms are optional, and fetching them would surprise people).
fn relative_path(uri: &str) -> Result<PathBuf, String> {
    let refuse =
        |what| format!("its URI `{uri}` is {what}; only relative paths and data URIs are read");
    let scheme = uri.split(['/', '?', '#']).next().unwrap_or(uri);
    if scheme
        .split_once(':')
        .is_some_and(|(s, _)| !s.is_empty() && is_scheme(s))
    {
        return Err(refuse("not a path"));
    }
    let decoded = percent_decode(uri)?;
    let text = std::str::from_utf8(&decoded).map_err(|_| refuse("not UTF-8 when decoded"))?;
    if text.contains('\0') || text.is_empty() {
        return Err(refuse("not a path"));
    }
    let path = PathBuf::from(text);
    if path.has_root() || path.is_absolute() {
        return Err(refuse("an absolute path"));
    }
    Ok(path)
}

fn is_scheme(s: &str) -> bool {
    s.starts_with(|c: char| c.is_ascii_alphabetic())
        && s.chars()
            .all(|c| c.is_ascii_alphanumeric() || matches!(c, '+' | '-' | '.'))
}

/// `%20` and the like (RFC 3986 §2.1).
fn percent_decode(text: &str) -> Result<Cow<'_, [u8]>, String> {
    if !text.contains('%') {
        return Ok(Cow::Borrowed(text.as_bytes()));
    }
    let bytes = text.as_bytes();
    let digit = |at: usize| -> Option<u8> {
        let d = char::from(*bytes.get(at)?).to_digit(16)?;
        u8::try_from(d).ok()
    };
    let mut decoded = Vec::with_capacity(bytes.len());
    let mut at = 0;
    while at < bytes.len() {
        if bytes[at] == b'%' {
            let byte = digit(at + 1).zip(digit(at + 2)).map(|(h, l)| 16 * h + l);
            decoded.push(byte.ok_or("its URI has a `%` without two hexadecimal digits")?);
            at += 3;
        } else {
            decoded.push(bytes[at]);
            at += 1;
        }
    }
    Ok(Cow::Owned(decoded))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uris_become_relative_paths() {
        assert_eq!(
            relative_path("my%20mesh%C3%A4.bin").unwrap(),
            Path::new("my meshä.bin")
        );
        assert_eq!(
            relative_path("../b/a b.bin").unwrap(),
            Path::new("../b/a b.bin")
        );
        assert_eq!(
            relative_path("dir/a:b.bin").unwrap(),
            Path::new("dir/a:b.bin")
        );
    }

    #[test]
    fn other_uris_are_refused() {
        for uri in [
            "/etc/a",
            "http://x/y",
            "file:///x",
            "%2Fetc/a",
            "a%zz",
            "a%0",
            "%ff.bin",
            "a%00b",
            "",
        ] {
            assert!(relative_path(uri).is_err(), "{uri}");
        }
    }

    #[test]
    fn base64_is_read_with_and_without_padding() {
        for data in [
            "application/octet-stream;base64,AQID",
            ";base64,AQID",
            ";BASE64,AQID",
        ] {
            assert_eq!(decode_data(data).unwrap(), [1, 2, 3]);
        }
        assert_eq!(decode_data(";base64,AQI=").unwrap(), [1, 2]);
        assert_eq!(decode_data(";base64,AQI").unwrap(), [1, 2]);
        assert_eq!(decode_data(";base64,AQI%3D").unwrap(), [1, 2]);
        for bad in ["no comma", ",AQID", "text/plain,AQID", ";base64,A!ID"] {
            assert!(decode_data(bad).is_err(), "{bad}");
        }
    }
}
