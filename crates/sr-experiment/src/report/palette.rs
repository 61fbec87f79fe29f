//! Colours of curves, of frames and of their names, the same wherever a contender appears.

/// Okabe and Ito 2008, "Color Universal Design": told apart by people of all colour vision; their
/// yellow is too light for lines on paper, and grey stands in its place.
const COLOURS: [[u8; 3]; 8] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [204, 121, 167],
    [230, 159, 0],
    [86, 180, 233],
    [110, 110, 110],
    [0, 0, 0],
];

/// The colour of a contender by its place; after eight they begin again.
pub(super) fn colour(place: usize) -> [u8; 3] {
    COLOURS[place % COLOURS.len()]
}

/// Dashes of a curve in pixels: `None` is solid. Each round of colours has its own.
pub(super) fn dashes(place: usize) -> Option<[u32; 2]> {
    match place / COLOURS.len() {
        0 => None,
        round => Some([9, 3 * round.min(3) as u32]),
    }
}
