//! Lengths and checksums made right after damage, as a careful enemy would.

/// The lengths in the header of a binary glTF and of its first chunk.
pub(super) fn glb(bytes: &mut [u8]) {
    if !bytes.starts_with(b"glTF") || bytes.len() < 20 {
        return;
    }
    let word = |n: usize| u32::try_from(n).unwrap_or(u32::MAX).to_le_bytes();
    let whole = word(bytes.len());
    bytes[8..12].copy_from_slice(&whole);
    let binary = bytes.windows(4).rposition(|w| w == b"BIN\0");
    let end = binary.map_or(bytes.len(), |at| at.saturating_sub(4));
    if end >= 20 {
        let json = word(end - 20);
        bytes[12..16].copy_from_slice(&json);
    }
    if let Some(at) = binary.filter(|at| *at >= 24) {
        let rest = word(bytes.len() - at - 4);
        bytes[at - 4..at].copy_from_slice(&rest);
    }
}

/// The checksums of the chunks of a PNG, as far as their lengths lead.
pub(super) fn png(bytes: &mut [u8]) {
    if !bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
        return;
    }
    let mut at = 8;
    while let Some(head) = bytes.get(at..at + 8) {
        let length = u32::from_be_bytes([head[0], head[1], head[2], head[3]]) as usize;
        let end = at + 8 + length;
        if end + 4 > bytes.len() {
            return;
        }
        let sum = checksum(&bytes[at + 4..end]).to_be_bytes();
        bytes[end..end + 4].copy_from_slice(&sum);
        at = end + 4;
    }
}

/// CRC-32, bit by bit (ISO 3309; W3C 2003, "Portable Network Graphics", annex D).
fn checksum(bytes: &[u8]) -> u32 {
    let mut sum = u32::MAX;
    for &byte in bytes {
        sum ^= u32::from(byte);
        for _ in 0..8 {
            sum = sum >> 1 ^ if sum & 1 == 1 { 0xedb8_8320 } else { 0 };
        }
    }
    !sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_that_are_right_stay_as_they_are() {
        assert_eq!(
            checksum(b"123456789"),
            0xcbf4_3926,
            "the check value of the standard"
        );
        let whole = crate::fuzz::files("corpus", "gltf");
        let pictures = crate::fuzz::files("corpus", "picture");
        assert!(whole.len() > 2 && pictures.len() > 10);
        for (name, bytes) in whole.into_iter().chain(pictures) {
            let mut repaired = bytes.clone();
            glb(&mut repaired);
            png(&mut repaired);
            assert_eq!(repaired, bytes, "{name}");
        }
    }
}
