//! The viewer's place on the page, empty until its script fills it.

use super::views::Views;
use crate::units::counted;

/// The element, and what a reader must know of its numbers.
pub(super) fn viewer(views: &Views) -> String {
    if views.sets.is_empty() {
        return String::new();
    }
    let mut text = String::from(
        "<div id=\"viewer\" class=\"viewer\" tabindex=\"0\" role=\"group\" aria-label=\"picture viewer\" hidden></div>\n\
         <p class=\"small needs-script\">The values are those of the EXR files, unrounded. The viewer exposes by \
         stops and shows by the sRGB curve, whatever tone map the developed pictures have.",
    );
    if views.factor > 1 {
        text += &format!(
            " The pictures are large: to keep this page small, a pixel here is the mean of {} × {} \
             ({} of the file); the EXR files have them all.",
            views.factor,
            views.factor,
            counted(u64::from(views.factor) * u64::from(views.factor), "pixel")
        );
    }
    text + "</p>\n"
}
