//! `<effect>`: the classic assignment's materials, and the diffuse part of `profile_COMMON`.
//!
//! Where the assignment's block is there, the Phong material beside it is a decoy that Blender
//! wrote; only the block counts.

use super::xml::{Reader, Xml, child, children, course_technique, label, path, start, tag};
use roxmltree::NodeId;
use std::collections::HashMap;

/// How a surface scatters light. Colours are linear, factors between 0 and 1.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Lobe {
    Lambert {
        reflectance: [f64; 3],
    },
    Mirror {
        reflectance: [f64; 3],
    },
    Refraction {
        transmittance: [f64; 3],
        ior: f64,
    },
    Dielectric {
        ior: f64,
        reflectance: [f64; 3],
        transmittance: [f64; 3],
    },
    /// The same with a rough surface, Beckmann.
    RoughDielectric {
        ior: f64,
        reflectance: [f64; 3],
        transmittance: [f64; 3],
        alpha: f64,
    },
    /// Beckmann, with a complex index of refraction.
    Conductor {
        eta: [f64; 3],
        k: [f64; 3],
        alpha: f64,
    },
}

/// A lobe and the light that the surface gives off on its front.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Surface {
    pub lobe: Lobe,
    pub emission: Option<[f64; 3]>,
}

/// A material of the file.
#[derive(Clone, Debug)]
pub(crate) struct Material {
    /// As the file calls it.
    pub name: String,
    pub surface: Surface,
}

/// What a surface without material looks like.
const GREY: Surface = Surface {
    lobe: Lobe::Lambert {
        reflectance: [0.5; 3],
    },
    emission: None,
};

/// The materials that are used, in the order of first use.
#[derive(Default)]
pub(crate) struct Materials {
    pub list: Vec<Material>,
    by_node: HashMap<NodeId, usize>,
    default: Option<usize>,
}

impl Materials {
    /// Index of a `<material>`, read on first use.
    pub fn index<'a>(&mut self, reader: &mut Reader<'a>, node: Xml<'a>) -> usize {
        if let Some(&i) = self.by_node.get(&node.id()) {
            return i;
        }
        let surface = child(node, "instance_effect")
            .or_else(|| {
                let message = format!("material `{}` names no effect", label(node));
                let hint = "a <material> needs an <instance_effect url=\"#...\"/>";
                reader.diag.error(start(node), message, hint);
                None
            })
            .and_then(|instance| {
                if child(instance, "setparam").is_some() {
                    let text = format!("dropped <setparam> of material `{}`", label(node));
                    reader.diag.note(text);
                }
                reader.resolve(instance, "url", &["effect"])
            })
            .and_then(|effect| reader.effect(effect, label(node)));
        let i = self.list.len();
        self.list.push(Material {
            name: label(node).to_owned(),
            // An error has been told where there is none.
            surface: surface.unwrap_or(GREY),
        });
        self.by_node.insert(node.id(), i);
        i
    }

    /// Index of the grey that stands in where no material is bound.
    pub fn default_index(&mut self) -> usize {
        *self.default.get_or_insert_with(|| {
            self.list.push(Material {
                name: "default".to_owned(),
                surface: GREY,
            });
            self.list.len() - 1
        })
    }
}

impl<'a> Reader<'a> {
    fn effect(&mut self, effect: Xml<'a>, name: &str) -> Option<Surface> {
        let Some(technique) = course_technique(effect) else {
            return self.common_profile(effect, name);
        };
        let mut blocks = technique.children().filter(|c| c.is_element());
        let Some(mut block) = blocks.next() else {
            let message = "an empty CGL block";
            let remedy = "the diffuse colour of profile_COMMON is used";
            self.diag.fault(start(technique), message, remedy);
            return self.common_profile(effect, name);
        };
        if let Some(last) = blocks.next_back() {
            let text = format!("material `{name}` has several CGL blocks: the last one is used");
            self.diag.note(text);
            block = last;
        }
        self.course_block(effect, block, name)
    }

    fn course_block(&mut self, effect: Xml<'a>, block: Xml<'a>, name: &str) -> Option<Surface> {
        let mut emission = None;
        let lobe = match tag(block) {
            "diffuse" => Lobe::Lambert {
                reflectance: self.factor(block, "reflectance")?,
            },
            "mirror" => Lobe::Mirror {
                reflectance: self.factor(block, "reflectance")?,
            },
            "refraction" => Lobe::Refraction {
                transmittance: self.factor(block, "transmittance")?,
                ior: self.above_zero(block, "ior")?,
            },
            "glass" => Lobe::Dielectric {
                ior: self.above_zero(block, "ior")?,
                reflectance: self.factor(block, "reflectance")?,
                transmittance: self.factor(block, "transmittance")?,
            },
            "microfacet" => Lobe::Conductor {
                eta: self.metal_eta(block)?,
                k: self.field(block, "k").and_then(|k| self.color(k))?,
                alpha: {
                    let node = self.field(block, "alpha")?;
                    self.alpha(node)?
                },
            },
            "emission" => {
                let radiance = self.field(block, "radiance")?;
                emission = Some(self.color(radiance)?);
                Lobe::Lambert {
                    reflectance: [0.0; 3],
                }
            }
            unknown => {
                let message = format!("`{unknown}` is no material of the CGL profile");
                let remedy = "the diffuse colour of profile_COMMON is used \
                              (known: diffuse, mirror, refraction, glass, microfacet, emission)";
                self.diag.fault(start(block), message, remedy);
                return self.common_profile(effect, name);
            }
        };
        let lobe = match child(block, "roughness") {
            Some(node) => {
                let alpha = self.alpha(node)?;
                self.roughened(lobe, alpha, name)
            }
            None => lobe,
        };
        Some(Surface { lobe, emission })
    }

    /// Glass of roughness `alpha`. The assignment's own program reads it and makes no use of it.
    fn roughened(&mut self, lobe: Lobe, alpha: f64, name: &str) -> Lobe {
        match lobe {
            Lobe::Dielectric {
                ior,
                reflectance,
                transmittance,
            } if alpha > 0.0 => Lobe::RoughDielectric {
                ior,
                reflectance,
                transmittance,
                alpha,
            },
            Lobe::Refraction { transmittance, ior } if alpha > 0.0 => {
                self.diag.note(format!(
                    "approximated material `{name}`: a rough refraction, as rough glass that absorbs \
                     what it reflects"
                ));
                Lobe::RoughDielectric {
                    ior,
                    reflectance: [0.0; 3],
                    transmittance,
                    alpha,
                }
            }
            smooth => smooth,
        }
    }

    fn field(&mut self, block: Xml<'a>, name: &'static str) -> Option<Xml<'a>> {
        let found = child(block, name);
        if found.is_none() {
            let message = format!("<{}> without <{name}>", tag(block));
            self.diag.error(start(block), message, "add it");
        }
        found
    }

    /// A colour between 0 and 1.
    fn factor(&mut self, block: Xml<'a>, name: &'static str) -> Option<[f64; 3]> {
        let node = self.field(block, name)?;
        let color = self.color(node)?;
        Some(self.at_most_one(node, color))
    }

    fn at_most_one(&mut self, node: Xml<'a>, color: [f64; 3]) -> [f64; 3] {
        if color.iter().any(|&x| x > 1.0) {
            let message = "more light would leave the surface than arrives: a colour above 1";
            self.diag.fault(start(node), message, "1 is taken");
        }
        color.map(|x| x.min(1.0))
    }

    fn above_zero(&mut self, block: Xml<'a>, name: &'static str) -> Option<f64> {
        let node = self.field(block, name)?;
        let x = self.number(node)?;
        if x > 0.0 {
            return Some(x);
        }
        let message = format!("<{name}> must be above 0");
        self.diag.error(start(node), message, "correct it");
        None
    }

    fn metal_eta(&mut self, block: Xml<'a>) -> Option<[f64; 3]> {
        let node = self.field(block, "eta")?;
        let eta = self.color(node)?;
        if eta.iter().all(|&x| x > 0.0) {
            return Some(eta);
        }
        let message = "<eta> must be above 0 in each channel";
        self.diag.error(start(node), message, "correct it");
        None
    }

    /// A microfacet roughness, `<alpha>` or `<roughness>`.
    fn alpha(&mut self, node: Xml<'a>) -> Option<f64> {
        let alpha = self.number(node)?;
        if !(0.0..=1.0).contains(&alpha) {
            let message = format!("<{}> must be between 0 and 1", tag(node));
            self.diag
                .fault(start(node), message, "the nearer end is taken");
        }
        Some(alpha.clamp(0.0, 1.0))
    }

    /// The diffuse and emitted light of `profile_COMMON`.
    fn common_profile(&mut self, effect: Xml<'a>, name: &str) -> Option<Surface> {
        let shader = path(effect, &["profile_COMMON", "technique"]).and_then(|t| {
            let known = ["lambert", "phong", "blinn", "constant"];
            t.children()
                .find(|c| c.is_element() && known.contains(&tag(*c)))
        });
        let Some(shader) = shader else {
            let message = format!("effect of material `{name}` has nothing that can be converted");
            let remedy = "a grey diffuse surface stands in";
            self.diag.fault(start(effect), message, remedy);
            return Some(GREY);
        };
        let emission = match child(shader, "emission") {
            Some(node) => self.common_color(effect, node, name)?,
            None => None,
        };
        let reflectance = match child(shader, "diffuse") {
            // A constant surface shows what it emits and scatters nothing.
            _ if tag(shader) == "constant" => [0.0; 3],
            None => [0.0; 3],
            Some(node) => match self.common_color(effect, node, name)? {
                Some(color) => self.at_most_one(node, color),
                None => [0.5; 3],
            },
        };
        self.say_what_is_dropped(effect, shader, name)?;
        Some(Surface {
            lobe: Lobe::Lambert { reflectance },
            emission: emission.filter(|e| *e != [0.0; 3]),
        })
    }

    /// A `<color>`, or a `<param>` that names one; `None` inside for a texture.
    fn common_color(
        &mut self,
        effect: Xml<'a>,
        node: Xml<'a>,
        name: &str,
    ) -> Option<Option<[f64; 3]>> {
        if let Some(color) = child(node, "color") {
            return self.color(color).map(Some);
        }
        if child(node, "texture").is_some() {
            let what = tag(node);
            let instead = if what == "diffuse" {
                "grey 0.5"
            } else {
                "nothing"
            };
            self.diag.note(format!(
                "dropped the {what} texture of material `{name}`: {instead} stands in"
            ));
            return Some(None);
        }
        let wanted = child(node, "param").and_then(|p| p.attribute("ref"));
        let Some(wanted) = wanted else {
            let message = format!("<{}> without <color>, <texture> or <param>", tag(node));
            self.diag.error(start(node), message, "give it a <color>");
            return None;
        };
        let value = [Some(effect), child(effect, "profile_COMMON")]
            .into_iter()
            .flatten()
            .flat_map(|n| children(n, "newparam"))
            .filter(|n| n.attribute("sid") == Some(wanted))
            .find_map(|n| child(n, "float4").or_else(|| child(n, "float3")));
        match value {
            Some(value) => self.color(value).map(Some),
            None => {
                let message = format!("no colour parameter `{wanted}` in this effect");
                let hint = "a <newparam> with <float3> or <float4> is needed";
                self.diag.error(start(node), message, hint);
                None
            }
        }
    }

    fn say_what_is_dropped(&mut self, effect: Xml<'a>, shader: Xml<'a>, name: &str) -> Option<()> {
        for (what, strength) in [("specular", None), ("reflective", Some("reflectivity"))] {
            let Some(node) = child(shader, what) else {
                continue;
            };
            let strength = strength.and_then(|s| path(shader, &[s, "float"]));
            let off = match strength {
                Some(s) => self.number(s)? == 0.0,
                None => false,
            };
            let color = self.common_color(effect, node, name)?;
            if !off && color.is_some_and(|c| c != [0.0; 3]) {
                self.diag
                    .note(format!("dropped the {what} part of material `{name}`"));
            }
        }
        if child(shader, "transparent").is_some() {
            self.diag.note(format!(
                "dropped the transparency of material `{name}`: writers disagree about its meaning"
            ));
        }
        Some(())
    }
}
