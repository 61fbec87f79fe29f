//! Every pointwise metric of two pictures at once, for text and JSON.

use super::pairs::{CompareError, mean_over, pairs};
use super::pointwise::{RELATIVE_OFFSET, mape, mean_error, mse, relmse, relmse_trimmed, smape};
use serde::Serialize;
use sr_film::{Image, RELMSE_OFFSET};

/// What [`compare`] finds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// Width of both pictures.
    pub width: u32,
    /// Height of both pictures.
    pub height: u32,
    /// Pixels compared: those that are finite in both.
    pub pixels: u64,
    /// Pixels of the picture that are not finite, and so left out.
    pub non_finite_image: u64,
    /// Pixels of the reference that are not finite, and so left out.
    pub non_finite_reference: u64,
    /// Mean of all channels of the picture over the pixels compared.
    pub mean_image: f64,
    /// Mean of all channels of the reference over the pixels compared.
    pub mean_reference: f64,
    /// [`mean_error`], red, green and blue.
    pub mean_error: [f64; 3],
    /// [`mse`].
    pub mse: f64,
    /// [`relmse`].
    pub relmse: f64,
    /// [`relmse_trimmed`].
    pub relmse_trimmed: f64,
    /// The constant in `relmse`'s denominator: [`RELMSE_OFFSET`].
    pub relmse_offset: f64,
    /// [`mape`].
    pub mape: f64,
    /// [`smape`].
    pub smape: f64,
    /// The constant in `mape`'s and `smape`'s denominators: [`RELATIVE_OFFSET`].
    pub relative_offset: f64,
}

impl Comparison {
    /// The figures with what they mean, as lines of text; the last has no line end.
    pub fn describe(&self) -> String {
        let Self {
            width,
            height,
            pixels,
            non_finite_image,
            non_finite_reference,
            mean_image,
            mean_reference,
            mean_error,
            mse,
            relmse,
            relmse_trimmed,
            relmse_offset,
            mape,
            smape,
            relative_offset,
        } = self;
        let left_out = u64::from(*width) * u64::from(*height) - pixels;
        let mut text = format!("{width} × {height} pixels");
        if left_out > 0 {
            text += &format!(
                ", {left_out} left out as not finite ({non_finite_image} in the image, \
                 {non_finite_reference} in the reference)"
            );
        }
        let relative_mean = 100.0 * (mean_image / mean_reference - 1.0);
        text += &format!("\nmean   {mean_image:.6} against {mean_reference:.6}");
        if relative_mean.is_finite() {
            text += &format!(" ({relative_mean:+.3} %)");
        }
        let [r, g, b] = mean_error;
        text += &format!(
            "\nerror  {r:+.4e} {g:+.4e} {b:+.4e}  mean of x − r by channel; noise cancels in it, bias stays"
        );
        text += &format!(
            "
MSE    {mse:.4e}  mean squared error; bright regions decide it
relMSE {relmse:.4e}  mean of (x − r)² / (r² + {relmse_offset}); dark and bright weigh alike
       {relmse_trimmed:.4e}  trimmed: without the worst 0.1 % of pixels; far less: fireflies
MAPE   {mape:.4e}  mean of |x − r| / (|r| + {relative_offset}); outliers weigh less
SMAPE  {smape:.4e}  mean of |x − r| / (|x| + |r| + {relative_offset}); 0 to 1
All are 0 for equal pictures and hold the reference's own noise."
        );
        text
    }
}

/// Every metric of a picture against a reference.
///
/// # Errors
/// Pictures of different size, or without a pixel that is finite in both.
pub fn compare(image: &Image, reference: &Image) -> Result<Comparison, CompareError> {
    let non_finite = |i: &Image| i.pixels.iter().filter(|p| !p.is_finite()).count() as u64;
    Ok(Comparison {
        width: image.width,
        height: image.height,
        pixels: pairs(image, reference)?.count() as u64,
        non_finite_image: non_finite(image),
        non_finite_reference: non_finite(reference),
        mean_image: mean_over(image, reference, |x, _| x)?,
        mean_reference: mean_over(image, reference, |_, r| r)?,
        mean_error: mean_error(image, reference)?.to_array(),
        mse: mse(image, reference)?,
        relmse: relmse(image, reference)?,
        relmse_trimmed: relmse_trimmed(image, reference)?,
        relmse_offset: RELMSE_OFFSET,
        mape: mape(image, reference)?,
        smape: smape(image, reference)?,
        relative_offset: RELATIVE_OFFSET,
    })
}

#[cfg(test)]
mod tests {
    use super::super::debiased;
    use super::*;
    use glam::Vec3;

    fn image(pixels: &[[f32; 3]]) -> Image {
        Image {
            width: pixels.len() as u32,
            height: 1,
            pixels: pixels.iter().map(|&p| p.into()).collect(),
        }
    }

    /// Bounds the few roundings of double precision.
    fn assert_close(a: f64, b: f64) {
        assert!((a - b).abs() <= 1e-15 * b.abs(), "{a} is not {b}");
    }

    /// All values are exact in binary, the results by hand.
    #[test]
    fn metrics_are_their_formulas() {
        let x = image(&[[1.0, 0.5, 0.0], [4.0, 0.0, 2.0]]);
        let r = image(&[[1.0, 0.25, 0.5], [2.0, 0.0, 2.0]]);
        assert_close(mse(&x, &r).unwrap(), (0.0625 + 0.25 + 4.0) / 6.0);
        assert_close(
            relmse(&x, &r).unwrap(),
            (0.0625 / 0.0725 + 0.25 / 0.26 + 4.0 / 4.01) / 6.0,
        );
        assert_close(
            mape(&x, &r).unwrap(),
            (0.25 / 0.26 + 0.5 / 0.51 + 2.0 / 2.01) / 6.0,
        );
        assert_close(
            smape(&x, &r).unwrap(),
            (0.25 / 0.76 + 0.5 / 0.51 + 2.0 / 6.01) / 6.0,
        );
    }

    #[test]
    fn negative_values_have_a_size_not_a_sign() {
        let (x, r) = (image(&[[-1.0, 1.0, 0.0]]), image(&[[1.0, -1.0, 0.0]]));
        assert_close(mape(&x, &r).unwrap(), 2.0 * 2.0 / 1.01 / 3.0);
        assert_close(smape(&x, &r).unwrap(), 2.0 * 2.0 / 2.01 / 3.0);
        assert_close(relmse(&x, &r).unwrap(), 2.0 * 4.0 / 1.01 / 3.0);
    }

    #[test]
    fn comparison_holds_the_single_metrics() {
        let x = image(&[[1.0, 0.5, 0.0], [4.0, 0.0, 2.0]]);
        let r = image(&[[1.0, 0.25, 0.5], [2.0, 0.0, 2.0]]);
        let c = compare(&x, &r).unwrap();
        assert_eq!(c.mse, mse(&x, &r).unwrap());
        assert_eq!(c.relmse, relmse(&x, &r).unwrap());
        assert_eq!(c.mape, mape(&x, &r).unwrap());
        assert_eq!(c.smape, smape(&x, &r).unwrap());
        assert_close(c.mean_image, 7.5 / 6.0);
        assert_close(c.mean_reference, 5.75 / 6.0);
        assert_eq!((c.width, c.height, c.pixels), (2, 1, 2));

        let same = compare(&r, &r).unwrap();
        assert_eq!([same.mse, same.relmse, same.mape, same.smape], [0.0; 4]);
    }

    #[test]
    fn trimming_leaves_out_the_worst_thousandth() {
        let r = image(&[[0.0; 3]; 2000]);
        let mut x = r.clone();
        // Errors of 1 in relMSE, and two fireflies.
        x.pixels.fill(Vec3::splat(0.1));
        x.pixels[7] = Vec3::splat(1e6);
        x.pixels[1800] = Vec3::splat(1e5);
        let c = compare(&x, &r).unwrap();
        assert!((c.relmse_trimmed - 1.0).abs() < 1e-6, "{c:?}");
        assert!(c.relmse > 1e10);
        // Fewer than a thousand pixels: none is left out.
        let few = compare(&image(&[[0.1; 3], [0.0; 3]]), &image(&[[0.0; 3]; 2])).unwrap();
        assert_eq!(few.relmse_trimmed, few.relmse);
    }

    #[test]
    fn pixels_that_are_not_finite_are_left_out_and_said() {
        let x = image(&[[1.0; 3], [f32::NAN, 0.0, 0.0], [9.0; 3], [3.0; 3]]);
        let r = image(&[[2.0; 3], [1.0; 3], [1.0, f32::INFINITY, 1.0], [3.0; 3]]);
        let c = compare(&x, &r).unwrap();
        assert_eq!(
            (c.pixels, c.non_finite_image, c.non_finite_reference),
            (2, 1, 1)
        );
        assert_close(c.mse, 0.5);
        assert_close(c.mean_image, 2.0);
        let text = c.describe();
        assert!(
            text.contains("2 left out as not finite (1 in the image, 1 in the reference)"),
            "{text}"
        );
        let none = image(&[[f32::NAN; 3]; 4]);
        assert_eq!(compare(&none, &r), Err(CompareError::NothingToCompare));
    }

    #[test]
    fn sizes_that_differ_are_both_named() {
        let wide = Image::filled(6, 2, Vec3::ONE);
        let tall = Image::filled(3, 4, Vec3::ONE);
        let text = compare(&wide, &tall).unwrap_err().to_string();
        assert!(text.contains("6 × 2") && text.contains("3 × 4"), "{text}");
    }

    #[test]
    fn text_and_json_hold_every_figure() {
        let c = compare(&image(&[[0.5; 3]]), &image(&[[0.25; 3]])).unwrap();
        let text = c.describe();
        for part in [
            "MSE    6.2500e-2",
            "relMSE 8.6207e-1",
            "+ 0.01",
            "(+100.000 %)",
        ] {
            assert!(text.contains(part), "no {part} in\n{text}");
        }
        assert!(!text.contains("left out"));
        let json = serde_json::to_value(&c).unwrap();
        assert_eq!(json["mse"], 0.0625);
        assert_eq!(json["relmse_offset"], 0.01);
        assert_eq!(json["pixels"], 1);
    }

    /// By hand: errors 0, 1/4, −1/2 and 2, 0, 0; trimming is tested above.
    #[test]
    fn the_signed_error_keeps_its_sign() {
        let x = image(&[[1.0, 0.5, 0.0], [4.0, 0.0, 2.0]]);
        let r = image(&[[1.0, 0.25, 0.5], [2.0, 0.0, 2.0]]);
        assert_eq!(mean_error(&x, &r).unwrap().to_array(), [1.0, 0.125, -0.25]);
        assert_eq!(compare(&x, &r).unwrap().mean_error, [1.0, 0.125, -0.25]);
    }

    #[test]
    fn the_references_noise_is_subtracted() {
        let x = image(&[[1.0, 0.5, 0.0], [4.0, 0.0, 2.0]]);
        let r = image(&[[1.0, 0.25, 0.5], [2.0, 0.0, 2.0]]);
        let v = image(&[[0.0, 0.0, 0.0625], [0.125, 0.0, 0.0]]);
        let d = debiased(&x, &r, &v).unwrap();
        assert_close(d.reference_mse, 0.1875 / 6.0);
        assert_close(d.mse, (0.0625 + 0.25 + 4.0 - 0.1875) / 6.0);
        let own = (0.0625 / 0.26 + 0.125 / 4.01) / 6.0;
        assert_close(d.reference_relmse, own);
        assert_close(d.relmse, relmse(&x, &r).unwrap() - own);
    }

    #[test]
    fn a_reference_that_is_not_good_enough_is_refused_in_words() {
        let x = image(&[[1.0; 3], [2.0; 3]]);
        let r = image(&[[1.5; 3], [2.5; 3]]);
        let with = |v: f32| debiased(&x, &r, &image(&[[v; 3]; 2]));
        // Both measure 1/4 in MSE: a quarter of it is allowed.
        assert!(with(0.0625).is_ok());
        let text = with(0.125).unwrap_err().to_string();
        assert!(text.contains("its own noise is 50 %"), "{text}");
        assert!(text.contains("3 times as many samples"), "{text}");
        let text = with(0.5).unwrap_err().to_string();
        assert!(
            text.contains("200 %") && text.contains("far more"),
            "{text}"
        );
        let text = with(f32::INFINITY).unwrap_err().to_string();
        assert!(text.contains("not known at 2 pixels"), "{text}");
        assert!(with(-1.0).is_err() && with(f32::NAN).is_err());
        let text = debiased(&x, &r, &image(&[[0.0; 3]]))
            .unwrap_err()
            .to_string();
        assert!(text.contains("1 × 1") && text.contains("2 × 1"), "{text}");
        // Equal to a reference that claims no noise: nothing to refuse.
        assert_eq!(debiased(&r, &r, &image(&[[0.0; 3]; 2])).unwrap().mse, 0.0);
        assert!(debiased(&r, &r, &image(&[[0.1; 3]; 2])).is_err());
    }
}
