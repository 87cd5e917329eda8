//! Reader of safetensors: a header in JSON, and numbers.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::error::MatchError;

/// Largest file, bytes: a hundred times that of the policies in the package.
const MAX_SIZE: usize = 1 << 24;

/// An array of a file, as f32.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Array {
    pub(crate) shape: Vec<usize>,
    pub(crate) values: Vec<f32>,
}

/// Arrays and texts of a file, by name.
pub(crate) type Content = (BTreeMap<String, Array>, BTreeMap<String, String>);

#[derive(Deserialize)]
struct Entry {
    dtype: String,
    shape: Vec<usize>,
    data_offsets: [usize; 2],
}

#[derive(Deserialize)]
struct Header {
    #[serde(default, rename = "__metadata__")]
    metadata: BTreeMap<String, String>,
    #[serde(flatten)]
    arrays: BTreeMap<String, Entry>,
}

/// Reads a file with arrays of float16 and float32.
///
/// # Errors
/// Other bytes, or numbers that are not finite.
pub(crate) fn read(bytes: &[u8]) -> Result<Content, MatchError> {
    let wrong = |what: String| MatchError::Policy(format!("no usable safetensors file: {what}"));
    let cut_off = || wrong("it is cut off".to_owned());
    if bytes.len() > MAX_SIZE {
        return Err(wrong(format!("it has {} bytes, the maximum is {MAX_SIZE}", bytes.len())));
    }
    let (length, rest) = bytes.split_first_chunk::<8>().ok_or_else(cut_off)?;
    let length = usize::try_from(u64::from_le_bytes(*length)).map_err(|_| cut_off())?;
    let (header, data) = rest.split_at_checked(length).ok_or_else(cut_off)?;
    let header: Header =
        serde_json::from_slice(header).map_err(|error| wrong(error.to_string()))?;
    let mut arrays = BTreeMap::new();
    for (name, entry) in header.arrays {
        let [start, stop] = entry.data_offsets;
        let content = data.get(start..stop).ok_or_else(cut_off)?;
        let values: Vec<f32> = match entry.dtype.as_str() {
            "F32" => words(content).map(f32::from_le_bytes).collect(),
            "F16" => words(content).map(half).collect(),
            other => return Err(wrong(format!("array {name:?} has the type {other}"))),
        };
        let width = if entry.dtype == "F32" { 4 } else { 2 };
        let numbers =
            entry.shape.iter().try_fold(1_usize, |product, size| product.checked_mul(*size));
        if numbers.is_none_or(|numbers| numbers.checked_mul(width) != Some(content.len())) {
            return Err(wrong(format!("array {name:?} has other numbers than its shape says")));
        }
        if !values.iter().all(|value| value.is_finite()) {
            return Err(wrong(format!("array {name:?} has numbers that are not finite")));
        }
        arrays.insert(name, Array { shape: entry.shape, values });
    }
    Ok((arrays, header.metadata))
}

/// The words of some bytes; a rest is left out.
fn words<const N: usize>(bytes: &[u8]) -> impl Iterator<Item = [u8; N]> {
    bytes.chunks_exact(N).filter_map(|word| word.try_into().ok())
}

/// A number of 16 bits (IEEE 754 binary16), exactly.
fn half(bytes: [u8; 2]) -> f32 {
    let bits = u16::from_le_bytes(bytes);
    let sign = if bits & 0x8000 == 0 { 1.0 } else { -1.0 };
    let (exponent, fraction) = (bits >> 10 & 0x1F, f32::from(bits & 0x3FF));
    let power = |exponent: u16| f32::from_bits((u32::from(exponent) + 127 - 25) << 23);
    sign * match exponent {
        0 => fraction * power(1),
        31 if fraction > 0.0 => f32::NAN,
        31 => f32::INFINITY,
        _ => (1024.0 + fraction) * power(exponent),
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A file of float32 arrays.
    pub(crate) fn file(arrays: &[(&str, &[usize], &[f32])], metadata: &[(&str, &str)]) -> Vec<u8> {
        let mut header = serde_json::Map::new();
        let texts = metadata.iter().map(|(key, value)| ((*key).to_owned(), (*value).into()));
        header.insert("__metadata__".to_owned(), serde_json::Value::Object(texts.collect()));
        let mut data = Vec::new();
        for (name, shape, values) in arrays {
            let start = data.len();
            data.extend(values.iter().flat_map(|value| value.to_le_bytes()));
            let entry = serde_json::json!({
                "dtype": "F32", "shape": shape, "data_offsets": [start, data.len()]
            });
            header.insert((*name).to_owned(), entry);
        }
        let text = serde_json::Value::Object(header).to_string();
        [&(text.len() as u64).to_le_bytes(), text.as_bytes(), &data].concat()
    }

    #[test]
    #[allow(clippy::float_cmp)] // exact by definition
    fn half_numbers_are_exact() {
        let known = [
            (0x3C00_u16, 1.0),
            (0xC000, -2.0),
            (0x7BFF, 65504.0),
            (0x0001, 5.960_464_5e-8),
            (0x0400, 6.103_515_6e-5),
            (0x3555, 0.333_251_95),
        ];
        for (bits, value) in known {
            assert_eq!(half(bits.to_le_bytes()), value);
        }
        assert!(!half([0, 0x7C]).is_finite() && half([1, 0x7C]).is_nan());
    }

    #[test]
    fn files_come_back_and_wrong_ones_are_refused() {
        let bytes = file(&[("a", &[2, 1], &[0.5, -3.0])], &[("task", "T")]);
        let (arrays, metadata) = read(&bytes).expect("a file");
        assert_eq!(arrays["a"], Array { shape: vec![2, 1], values: vec![0.5, -3.0] });
        assert_eq!(metadata["task"], "T");
        for wrong in [
            &bytes[..4],
            &bytes[..bytes.len() - 1],
            b"12345678{}",
            &file(&[("a", &[3], &[0.5, 1.0])], &[]),
            &file(&[("a", &[1], &[f32::NAN])], &[]),
            &file(&[("a", &[usize::MAX, 2], &[1.0])], &[]),
        ] {
            assert!(read(wrong).is_err());
        }
    }
}
