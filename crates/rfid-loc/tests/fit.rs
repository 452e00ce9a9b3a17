//! What readings that are not as modelled do to what is believed of a tag.

use nalgebra::{Point2, Vector2};
use ogm_core::{TagEstimate, TagReading};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};
use rfid_loc::{FilterParams, Likelihood, localise};

const TAGS: u32 = 12;

fn place(number: u32) -> Point2<f64> {
    let angle = 0.5 * f64::from(number);
    Point2::new(1.7 * angle.cos(), 1.2 * angle.sin())
}

/// Twelve tags around a robot that drives an eight of 2 m; `read` is what it makes of a distance.
fn estimates(
    params: &FilterParams,
    mut read: impl FnMut(f64, &mut ChaCha8Rng) -> f64,
) -> Vec<TagEstimate> {
    let mut random = ChaCha8Rng::seed_from_u64(23);
    let mut log = Vec::new();
    for step in 0..240 {
        let angle = std::f64::consts::TAU * f64::from(step) / 240.0;
        let robot_position = Point2::new(angle.sin(), 0.7 * (2.0 * angle).sin());
        for number in 0..TAGS {
            let range = read((place(number) - robot_position).norm(), &mut random);
            log.push(TagReading { tag_id: number.into(), robot_position, range });
        }
    }
    localise(&log, params, &()).expect("usable parameters")
}

fn off(tag: &TagEstimate) -> Vector2<f64> {
    let number = u32::try_from(tag.tag_id.bits()).expect("one of the twelve");
    tag.position - place(number)
}

fn error(tag: &TagEstimate) -> f64 {
    off(tag).norm()
}

fn normal(sigma: f64) -> Normal<f64> {
    Normal::new(0.0, sigma).expect("a finite sigma")
}

/// Tags that are believed above `certainty` though they are off by more than 5 cm.
fn wrongly_believed(tags: &[TagEstimate], certainty: f64) -> usize {
    tags.iter().filter(|tag| tag.certainty > certainty && error(tag) > 0.05).count()
}

#[test]
fn readings_as_modelled_are_believed_and_as_near_as_their_covariance_says() {
    let noise = normal(0.05);
    let tags = estimates(&FilterParams::default(), |range, random| range + noise.sample(random));
    let mut nees = 0.0;
    for tag in &tags {
        assert!(tag.certainty > 0.9 && (0.85..1.15).contains(&tag.misfit), "{tag:?}");
        let off = off(tag);
        nees += (off.transpose() * tag.covariance.try_inverse().unwrap() * off)[0];
    }
    // A sum over 12 tags of χ² with two degrees of freedom lies within 12.4 and 39.4 in 95 of 100.
    assert!((8.0..42.0).contains(&nees), "{nees}");
}

#[test]
fn one_echo_in_ten_neither_moves_a_tag_nor_takes_its_certainty() {
    let noise = normal(0.05);
    let with_echoes = |range: f64, random: &mut ChaCha8Rng| {
        let echo = if random.random::<f64>() < 0.1 { 1.5 * random.random::<f64>() } else { 0.0 };
        (range + echo + noise.sample(random)).min(3.2)
    };
    let tags = estimates(&FilterParams::default(), with_echoes);
    assert!(tags.iter().all(|tag| tag.certainty > 0.9 && error(tag) < 0.02), "{tags:?}");

    let gaussian = FilterParams { likelihood: Likelihood::Gaussian, ..FilterParams::default() };
    let pulled = estimates(&gaussian, with_echoes);
    assert!(pulled.iter().any(|tag| error(tag) > 0.05), "an annulus without an end is pulled");
    assert_eq!(wrongly_believed(&pulled, 0.9), 0, "{pulled:?}");
}

#[test]
fn a_bias_is_noticed_and_the_tag_not_believed() {
    let noise = normal(0.05);
    for bias in [0.2, -0.2] {
        let read = |range: f64, random: &mut ChaCha8Rng| {
            (range + bias + noise.sample(random)).clamp(0.0, 3.2)
        };
        let tags = estimates(&FilterParams::default(), read);
        assert!(tags.iter().any(|tag| error(tag) > 0.05), "the test must be able to fail");
        assert_eq!(wrongly_believed(&tags, 0.75), 0, "{bias}: {tags:?}");
        let unchecked = FilterParams { check_fit: false, ..FilterParams::default() };
        assert!(wrongly_believed(&estimates(&unchecked, read), 0.9) > 0, "{bias}");
    }
}

#[test]
fn a_reader_ten_times_as_noisy_as_modelled_is_not_believed() {
    let noise = normal(0.5);
    let read = |range: f64, random: &mut ChaCha8Rng| (range + noise.sample(random)).clamp(0.0, 3.2);
    for likelihood in [Likelihood::Gaussian, Likelihood::Truncated] {
        let tags = estimates(&FilterParams { likelihood, ..FilterParams::default() }, read);
        assert!(tags.iter().all(|tag| tag.certainty < 0.75 && tag.misfit > 3.0), "{tags:?}");
    }
    let told = estimates(&FilterParams::for_reader(3.0, 0.5), read);
    let sure = told.iter().filter(|tag| tag.certainty > 0.9 && error(tag) < 0.3).count();
    assert!(sure >= 10, "a filter that knows its reader is sure within its cells: {told:?}");
}
