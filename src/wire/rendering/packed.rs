//! Large parts of an answer are kept compressed: packed once by the worker that wrote them, however often they are read.

use crate::jobs::Part;
use bytes::buf::Reader;
use bytes::{Buf, Bytes};
use flate2::Compression;
use flate2::bufread::GzDecoder;
use flate2::write::GzEncoder;
use std::io::{self, Read, Write};

/// Parts of more bytes are packed. Shorter ones are compressed quickly enough as they are sent.
const LARGE: usize = 256 << 10;

/// How hard they are packed: a hundred megabytes of numbers come to a third.
const LEVEL: Compression = Compression::new(3);

/// Bytes unpacked at once: a fraction of a millisecond.
const STEP: usize = 64 << 10;

/// A part as it is kept.
pub(super) fn packed(plain: Vec<u8>) -> Part {
    // Copied: what is only cut off stays in all the room that it was written in.
    let kept = |bytes: &[u8], packed_from| Part { body: Ok(Bytes::copy_from_slice(bytes)), packed_from };
    if plain.len() <= LARGE {
        return kept(&plain, None);
    }
    let mut packer = GzEncoder::new(Vec::new(), LEVEL);
    // Writing to memory cannot fail.
    match packer.write_all(&plain).and_then(|()| packer.finish()) {
        Ok(packed) => kept(&packed, Some(plain.len())),
        Err(_) => kept(&plain, None),
    }
}

/// What a part says, whole.
///
/// # Errors
/// Where the answer has no such part, why; where its bytes cannot be unpacked, that.
pub fn plain(part: &Part) -> Result<Bytes, String> {
    let body = part.body.clone()?;
    let Some(length) = part.packed_from else { return Ok(body) };
    let mut plain = Vec::with_capacity(length);
    GzDecoder::new(body.reader()).read_to_end(&mut plain).map_err(|error| error.to_string())?;
    Ok(plain.into())
}

/// What packed bytes say, a step at a time.
pub struct Unpacking(GzDecoder<Reader<Bytes>>);

impl Unpacking {
    /// From the first byte.
    pub fn new(packed: Bytes) -> Self {
        Unpacking(GzDecoder::new(packed.reader()))
    }
}

impl Iterator for Unpacking {
    type Item = io::Result<Bytes>;

    fn next(&mut self) -> Option<Self::Item> {
        let mut step = Vec::with_capacity(STEP);
        match self.0.by_ref().take(STEP as u64).read_to_end(&mut step) {
            Ok(0) => None,
            Ok(_) => Some(Ok(step.into())),
            Err(error) => Some(Err(error)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_packed_unpacks_to_itself_whole_and_in_steps() {
        let text: Vec<u8> = (0..200_000).flat_map(|i| format!("{i},").into_bytes()).collect();
        let part = packed(text.clone());
        let bytes = part.body.clone().unwrap();
        assert!(part.packed_from == Some(text.len()) && bytes.len() < text.len() / 2);
        let steps: Vec<_> = Unpacking::new(bytes.clone()).map(Result::unwrap).collect();
        assert!(steps.iter().all(|step| step.len() <= STEP) && steps.concat() == text);
        assert!(plain(&part).unwrap() == text);
        let cut = Unpacking::new(part.body.unwrap().slice(..1000));
        assert!(cut.into_iter().any(|step| step.is_err()), "what is cut off is no whole answer");
    }

    #[test]
    fn short_parts_are_kept_as_they_are() {
        let whole = Part { body: Ok(vec![b' '; LARGE].into()), packed_from: None };
        assert_eq!(packed(vec![b' '; LARGE]), whole);
    }
}
