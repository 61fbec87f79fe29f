//! Damaged files: whatever is in them, the reader ends without a panic.

use super::*;

const OBJ: &str = "# a box\nmtllib none.mtl\no a b\nv 0 0 0\nv 1 0 0 1\nv 1 1 0\nv 0.5 0.5 0 1 0 0\nv 0 1 0\n\
    vt 0 0\nvt 1 0\nvn 0 0 1\nvn 0 1 0\ns off\nusemtl red\nf 1//1 2//1 3//2\nf 1/1/1 3/2/1 \\\n 4/1/1 5/1/1\ng c\n\
    f -5 -4 -3 -2 -1\nl 1 2 3\nusemtl blue\nf 1 2 3 4 5\nf 5 4 3 2 1\n";

const MTL: &str = "newmtl red\nKa 1 1 1\nKd 0.5 0.25 0.125\nKs 0.5 0.5 0.5\nKe 1 2 3\nNs 30\nNi 1.5\nd 0.5\n\
    Tf 1 0.5 0.25\nillum 7\nmap_Kd -s 1 1 1 a b.png\nnewmtl blue\nPr 0.5\nPm 1\nTr 0.5\nbump b.png\n";

struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 33) as usize % n
    }
}

/// Flips, cuts, repeats, and swaps words for others.
fn mutate(seed: &str, random: &mut Random) -> Vec<u8> {
    let words: [&[u8]; 14] = [
        b"0",
        b"-1",
        b"9223372036854775807",
        b"-9223372036854775808",
        b"1e39",
        b"nan",
        b"",
        b"/",
        b"//",
        b"\n",
        b"\\\n",
        b"f",
        b"\xff\xfe",
        b"newmtl",
    ];
    let mut bytes = seed.as_bytes().to_vec();
    for _ in 0..1 + random.below(6) {
        let at = random.below(bytes.len().max(1)).min(bytes.len());
        let length = random.below(24).min(bytes.len() - at);
        match random.below(6) {
            0 if at < bytes.len() => bytes[at] ^= 1 << random.below(8),
            1 => drop(bytes.drain(at..at + length)),
            2 => bytes.truncate(at.max(1)),
            3 => {
                let again = bytes[at..at + length].to_vec();
                bytes.splice(at..at, again);
            }
            _ => {
                let word = |b: &u8| !b.is_ascii_whitespace();
                let end = bytes[at..]
                    .iter()
                    .position(|b| !word(b))
                    .map_or(bytes.len(), |i| at + i);
                bytes.splice(at..end, words[random.below(words.len())].iter().copied());
            }
        }
    }
    bytes
}

#[test]
fn damaged_models_end_with_a_model_or_errors() {
    let seed = OBJ.replace("mtllib none.mtl\n", "");
    read(&seed);
    let mut random = Random(20_240_612);
    let mut survivors = 0;
    for _ in 0..12_000 {
        let bytes = mutate(&seed, &mut random);
        match try_read(&bytes) {
            Ok(model) => {
                survivors += 1;
                for part in model.nodes.iter().flat_map(|n| &n.parts) {
                    let vertices = part.mesh.positions.len();
                    // A corner takes two bytes at least.
                    assert!(
                        3 * part.mesh.indices.len() < 3 * bytes.len() && vertices < bytes.len()
                    );
                    assert!(
                        part.mesh
                            .indices
                            .iter()
                            .flatten()
                            .all(|v| (*v as usize) < vertices)
                    );
                    assert!(part.mesh.positions.iter().flatten().all(|x| x.is_finite()));
                    assert!(part.mesh.normals.is_empty() || part.mesh.normals.len() == vertices);
                    assert!(part.material.is_some_and(|m| m < model.materials.len()));
                }
            }
            Err(errors) => assert!(!errors.is_empty()),
        }
    }
    assert!(
        survivors > 500,
        "only {survivors} were read, so little was tested"
    );
}

#[test]
fn damaged_libraries_end_with_materials_or_errors() {
    let mut random = Random(20_240_613);
    for _ in 0..12_000 {
        let text = mutate(MTL, &mut random);
        let mut report = Report::new(Path::new("a.obj"));
        let text = String::from_utf8_lossy(&text);
        let materials = crate::obj::library::read_library(&text, Path::new("a.mtl"), &mut report);
        assert!(materials.len() <= text.len());
    }
}

#[test]
fn long_lines_and_names_take_linear_time() {
    // Would take minutes if the column of each word, or the distance of two names, were computed.
    let mut text = String::from("v 0 0 0\nv 1 0 0\nv 0 1 0\nf");
    for _ in 0..400_000 {
        text += " 1 2 3";
    }
    read(&text);
    let long = "x".repeat(400_000);
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("a.mtl"), format!("newmtl {long}y\n")).unwrap();
    let obj = format!("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl {long}\nf 1 2 3\n");
    let path = dir.path().join("a.obj");
    std::fs::write(&path, obj).unwrap();
    assert_eq!(crate::obj::read(&path).unwrap_err().len(), 1);
}
