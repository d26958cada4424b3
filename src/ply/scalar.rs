//! The scalar types of PLY, and their values in binary.

use half::f16;

/// A scalar type of a property, a list's count or a list's items.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F16,
    F32,
    F64,
}

impl Scalar {
    /// The type that a header's word names, in any case. Besides the names of the original format and
    /// those with a width this knows the 64-bit integers and half floats that trimesh writes, and the
    /// short codes that plyfile reads.
    pub(super) fn named(word: &[u8]) -> Option<Self> {
        Some(match word.to_ascii_lowercase().as_slice() {
            b"char" | b"int8" | b"i1" => Self::I8,
            b"uchar" | b"uint8" | b"u1" => Self::U8,
            b"short" | b"int16" | b"i2" => Self::I16,
            b"ushort" | b"uint16" | b"u2" => Self::U16,
            b"int" | b"int32" | b"i4" => Self::I32,
            b"uint" | b"uint32" | b"u4" => Self::U32,
            b"int64" | b"i8" => Self::I64,
            b"uint64" | b"u8" => Self::U64,
            b"float16" | b"half" | b"f2" => Self::F16,
            b"float" | b"float32" | b"f4" => Self::F32,
            b"double" | b"float64" | b"f8" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes of a value in binary, 1 to 8.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 | Self::F16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }

    /// Whether its values may have a fraction.
    pub(super) fn is_float(self) -> bool {
        matches!(self, Self::F16 | Self::F32 | Self::F64)
    }
}

/// A scalar of `SIZE` bytes in a binary file.
pub(super) trait FromBytes<const SIZE: usize> {
    fn from_bytes(bytes: [u8; SIZE], big_endian: bool) -> f64;
}

// The conversion to `f64` loses nothing, except of 64-bit integers: no column needs more.
macro_rules! from_bytes {
    ($($kind:ty, $size:literal, $to_f64:expr;)*) => {$(
        impl FromBytes<$size> for $kind {
            #[inline(always)]
            fn from_bytes(bytes: [u8; $size], big_endian: bool) -> f64 {
                let value = if big_endian { <$kind>::from_be_bytes(bytes) } else { <$kind>::from_le_bytes(bytes) };
                $to_f64(value)
            }
        }
    )*};
}

from_bytes! {
    i8, 1, f64::from;
    u8, 1, f64::from;
    i16, 2, f64::from;
    u16, 2, f64::from;
    i32, 4, f64::from;
    u32, 4, f64::from;
    i64, 8, |value| value as f64;
    u64, 8, |value| value as f64;
    f16, 2, f64::from;
    f32, 4, f64::from;
    f64, 8, |value| value;
}

/// The value at the start of `bytes`; `None` if they are too few.
pub(super) fn value(kind: Scalar, bytes: &[u8], big_endian: bool) -> Option<f64> {
    fn one<T: FromBytes<N>, const N: usize>(bytes: &[u8], big_endian: bool) -> Option<f64> {
        Some(T::from_bytes(*bytes.first_chunk::<N>()?, big_endian))
    }
    let read = match kind {
        Scalar::I8 => one::<i8, 1>,
        Scalar::U8 => one::<u8, 1>,
        Scalar::I16 => one::<i16, 2>,
        Scalar::U16 => one::<u16, 2>,
        Scalar::I32 => one::<i32, 4>,
        Scalar::U32 => one::<u32, 4>,
        Scalar::I64 => one::<i64, 8>,
        Scalar::U64 => one::<u64, 8>,
        Scalar::F16 => one::<f16, 2>,
        Scalar::F32 => one::<f32, 4>,
        Scalar::F64 => one::<f64, 8>,
    };
    read(bytes, big_endian)
}

#[cfg(test)]
mod tests {
    use super::{Scalar, value};

    #[test]
    fn half_floats_have_their_ieee_values() {
        let cases = [
            (0x0000, 0.0),
            (0x0001, 2f64.powi(-24)),
            (0x03ff, 1023.0 * 2f64.powi(-24)),
            (0x0400, 2f64.powi(-14)),
            (0x3555, 0.333_251_953_125),
            (0x3c00, 1.0),
            (0xc000, -2.0),
            (0x7bff, 65504.0),
            (0x7c00, f64::INFINITY),
            (0xfc00, f64::NEG_INFINITY),
        ];
        let read = |bytes: [u8; 2], big_endian| value(Scalar::F16, &bytes, big_endian).map(f64::to_bits);
        for (bits, expected) in cases {
            for (bytes, big_endian) in [(u16::to_le_bytes(bits), false), (u16::to_be_bytes(bits), true)] {
                assert_eq!(read(bytes, big_endian), Some(expected.to_bits()), "{bits:#06x}");
            }
        }
        assert!(value(Scalar::F16, &[0x00, 0x7e], false).is_some_and(f64::is_nan));
    }

    #[test]
    fn a_value_needs_all_its_bytes() {
        assert_eq!(
            value(Scalar::I32, &[0xfe, 0xff, 0xff, 0xff, 9], false),
            Some(-2.0)
        );
        assert_eq!(value(Scalar::I32, &[0xfe, 0xff, 0xff], false), None);
    }
}
