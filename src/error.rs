//! The errors there are: lengths that differ, and strides that do not fit.

use core::fmt;

/// Slices that belong together differ in length. Nothing was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LengthMismatch {
    /// Structure of arrays: the number of x, y and z components, and of codes.
    #[allow(missing_docs)]
    Soa { x: usize, y: usize, z: usize, codes: usize },
    /// Array of structures: the number of vectors, and of codes.
    #[allow(missing_docs)]
    Aos { vectors: usize, codes: usize },
    /// Codes as bytes: the number of x, y and z components, of bytes, and of bytes that one code
    /// takes.
    #[allow(missing_docs)]
    Bytes { x: usize, y: usize, z: usize, bytes: usize, code_size: usize },
    /// Array of structures and codes as bytes: the number of vectors, of bytes, and of bytes that one
    /// code takes.
    #[allow(missing_docs)]
    AosBytes { vectors: usize, bytes: usize, code_size: usize },
    /// Transcoding: the number of codes to read, and to write.
    #[allow(missing_docs)]
    Transcode { src: usize, dst: usize },
    /// Scalars, pairs and fields: the number of them, and of codes that each of them makes.
    #[allow(missing_docs)]
    Values { values: usize, codes: usize },
    /// Codes with a tag each: the number of codes or of their fields, of tags, and of packed words.
    #[allow(missing_docs)]
    Tagged { codes: usize, tags: usize, words: usize },
    /// Codes or signs without gaps: the number of them, of bytes, and of bits that one takes.
    #[allow(missing_docs)]
    Dense { codes: usize, bytes: usize, bits: u32 },
    /// A decode table: the number of vectors, and of entries that a table of the format has, `None`
    /// if the format has more than 16 bits and so no table.
    #[allow(missing_docs)]
    Table { vectors: usize, entries: Option<usize> },
    /// Vectors of two dimensions: the number of x and y components, and of codes.
    #[allow(missing_docs)]
    Angles { x: usize, y: usize, codes: usize },
    /// Quaternions as a structure of arrays: the number of x, y, z and w components, and of codes.
    #[allow(missing_docs)]
    Quaternions { x: usize, y: usize, z: usize, w: usize, codes: usize },
    /// Quaternions as a structure of arrays and codes as bytes: the number of x, y, z and w components, of bytes, and of
    /// bytes that one code takes.
    #[allow(missing_docs)]
    QuaternionBytes { components: [usize; 4], bytes: usize, code_size: usize },
    /// Tangent frames as structures of arrays: the number of x, y and z components of normals and of
    /// tangents, of handednesses, and of codes.
    #[allow(missing_docs)]
    FrameSoa { normal: [usize; 3], tangent: [usize; 3], handedness: usize, codes: usize },
    /// Tangent frames as structures of arrays and codes as bytes: the number of x, y and z components of normals and of
    /// tangents, of handednesses, of bytes, and of bytes that one code takes.
    #[allow(missing_docs)]
    FrameBytes {
        normal: [usize; 3],
        tangent: [usize; 3],
        handedness: usize,
        bytes: usize,
        code_size: usize,
    },
    /// Tangent frames as arrays of structures: the number of normals, of tangents, and of codes.
    #[allow(missing_docs)]
    FrameAos { normals: usize, tangents: usize, codes: usize },
}

impl LengthMismatch {
    #[inline]
    fn unless(self, fits: bool) -> Result<(), Self> {
        if fits { Ok(()) } else { Err(self) }
    }

    #[inline]
    pub(crate) fn check_soa(x: usize, y: usize, z: usize, codes: usize) -> Result<(), Self> {
        Self::Soa { x, y, z, codes }.unless([x, y, z] == [codes; 3])
    }

    #[inline]
    pub(crate) fn check_aos(vectors: usize, codes: usize) -> Result<(), Self> {
        Self::Aos { vectors, codes }.unless(vectors == codes)
    }

    #[inline]
    pub(crate) fn check_bytes(
        [x, y, z]: [usize; 3],
        bytes: usize,
        code_size: usize,
    ) -> Result<(), Self> {
        let fits = [y, z] == [x; 2] && x.checked_mul(code_size) == Some(bytes);
        Self::Bytes { x, y, z, bytes, code_size }.unless(fits)
    }

    #[inline]
    pub(crate) fn check_aos_bytes(
        vectors: usize,
        bytes: usize,
        code_size: usize,
    ) -> Result<(), Self> {
        let fits = vectors.checked_mul(code_size) == Some(bytes);
        Self::AosBytes { vectors, bytes, code_size }.unless(fits)
    }

    #[inline]
    pub(crate) fn check_transcode(src: usize, dst: usize) -> Result<(), Self> {
        Self::Transcode { src, dst }.unless(src == dst)
    }

    #[inline]
    pub(crate) fn check_values(values: usize, codes: usize) -> Result<(), Self> {
        Self::Values { values, codes }.unless(values == codes)
    }

    #[inline]
    pub(crate) fn check_tagged(codes: usize, tags: usize, words: usize) -> Result<(), Self> {
        Self::Tagged { codes, tags, words }.unless([codes, tags] == [words; 2])
    }

    #[inline]
    pub(crate) fn check_table(vectors: usize, entries: Option<usize>) -> Result<(), Self> {
        Self::Table { vectors, entries }.unless(entries == Some(vectors))
    }

    #[inline]
    pub(crate) fn check_signs(values: usize, bytes: usize) -> Result<(), Self> {
        Self::Dense { codes: values, bytes, bits: 1 }.unless(values.div_ceil(8) == bytes)
    }

    #[inline]
    pub(crate) fn check_quaternions([x, y, z, w]: [usize; 4], codes: usize) -> Result<(), Self> {
        Self::Quaternions { x, y, z, w, codes }.unless([x, y, z, w] == [codes; 4])
    }

    #[inline]
    pub(crate) fn check_quaternion_bytes(
        components: [usize; 4],
        bytes: usize,
        code_size: usize,
    ) -> Result<(), Self> {
        let len = components[0];
        let fits = components == [len; 4] && len.checked_mul(code_size) == Some(bytes);
        Self::QuaternionBytes { components, bytes, code_size }.unless(fits)
    }

    #[inline]
    pub(crate) fn check_angles(x: usize, y: usize, codes: usize) -> Result<(), Self> {
        Self::Angles { x, y, codes }.unless([x, y] == [codes; 2])
    }

    #[inline]
    pub(crate) fn check_frame_soa(
        normal: [usize; 3],
        tangent: [usize; 3],
        handedness: usize,
        codes: usize,
    ) -> Result<(), Self> {
        let fits = [normal, tangent] == [[codes; 3]; 2] && handedness == codes;
        Self::FrameSoa { normal, tangent, handedness, codes }.unless(fits)
    }

    #[inline]
    pub(crate) fn check_frame_bytes(
        normal: [usize; 3],
        tangent: [usize; 3],
        handedness: usize,
        bytes: usize,
        code_size: usize,
    ) -> Result<(), Self> {
        let fits = [normal, tangent] == [[handedness; 3]; 2]
            && handedness.checked_mul(code_size) == Some(bytes);
        Self::FrameBytes { normal, tangent, handedness, bytes, code_size }.unless(fits)
    }

    #[inline]
    pub(crate) fn check_frame_aos(
        normals: usize,
        tangents: usize,
        codes: usize,
    ) -> Result<(), Self> {
        Self::FrameAos { normals, tangents, codes }.unless([normals, tangents] == [codes; 2])
    }
}

impl fmt::Display for LengthMismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            LengthMismatch::Soa { x, y, z, codes } => {
                write!(f, "lengths differ: x {x}, y {y}, z {z}, codes {codes}")
            }
            LengthMismatch::Aos { vectors, codes } => {
                write!(f, "lengths differ: vectors {vectors}, codes {codes}")
            }
            LengthMismatch::Bytes { x, y, z, bytes, code_size } => write!(
                f,
                "lengths do not fit: x {x}, y {y}, z {z}, bytes {bytes} at {code_size} a code"
            ),
            LengthMismatch::AosBytes { vectors, bytes, code_size } => write!(
                f,
                "lengths do not fit: vectors {vectors}, bytes {bytes} at {code_size} a code"
            ),
            LengthMismatch::Transcode { src, dst } => {
                write!(f, "lengths differ: source {src}, destination {dst}")
            }
            LengthMismatch::Values { values, codes } => {
                write!(f, "lengths differ: values {values}, codes {codes}")
            }
            LengthMismatch::Tagged { codes, tags, words } => {
                write!(f, "lengths differ: codes {codes}, tags {tags}, words {words}")
            }
            LengthMismatch::Dense { codes, bytes, bits } => {
                write!(f, "lengths do not fit: codes {codes}, bytes {bytes} at {bits} bits a code")
            }
            LengthMismatch::Table { vectors, entries: Some(entries) } => {
                write!(f, "lengths differ: vectors {vectors}, entries of the table {entries}")
            }
            LengthMismatch::Table { vectors, entries: None } => write!(
                f,
                "vectors {vectors}, but formats of more than 16 bits have no decode table"
            ),
            LengthMismatch::Angles { x, y, codes } => {
                write!(f, "lengths differ: x {x}, y {y}, codes {codes}")
            }
            LengthMismatch::Quaternions { x, y, z, w, codes } => {
                write!(f, "lengths differ: x {x}, y {y}, z {z}, w {w}, codes {codes}")
            }
            LengthMismatch::QuaternionBytes { components: [x, y, z, w], bytes, code_size } => {
                write!(
                    f,
                    "lengths do not fit: x {x}, y {y}, z {z}, w {w}, bytes {bytes} at {code_size} a code"
                )
            }
            LengthMismatch::FrameSoa {
                normal: [x, y, z],
                tangent: [tx, ty, tz],
                handedness,
                codes,
            } => write!(
                f,
                "lengths differ: normal x {x}, y {y}, z {z}, tangent x {tx}, y {ty}, z {tz}, \
                 handedness {handedness}, codes {codes}"
            ),
            LengthMismatch::FrameBytes {
                normal: [x, y, z],
                tangent: [tx, ty, tz],
                handedness,
                bytes,
                code_size,
            } => write!(
                f,
                "lengths do not fit: normal x {x}, y {y}, z {z}, tangent x {tx}, y {ty}, z {tz}, \
                 handedness {handedness}, bytes {bytes} at {code_size} a code"
            ),
            LengthMismatch::FrameAos { normals, tangents, codes } => {
                write!(f, "lengths differ: normals {normals}, tangents {tangents}, codes {codes}")
            }
        }
    }
}

impl core::error::Error for LengthMismatch {}

/// Elements at a stride do not fit their bytes, or each other. Nothing was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum StrideMismatch {
    /// `len` elements of `size` bytes, of which the first begins at `offset` and the others `stride` bytes apart, end beyond
    /// the `bytes` that there are.
    #[allow(missing_docs)]
    Bounds { offset: usize, stride: usize, len: usize, size: usize, bytes: usize },
    /// The same numbers, of which the stride is less than the size of an element.
    #[allow(missing_docs)]
    Stride { offset: usize, stride: usize, len: usize, size: usize, bytes: usize },
    /// The number of vectors, and of codes.
    #[allow(missing_docs)]
    Lengths { vectors: usize, codes: usize },
    /// The number of normals, of tangents, and of codes.
    #[allow(missing_docs)]
    Frames { normals: usize, tangents: usize, codes: usize },
    /// Two fields of each of `len` elements, which begin at the bytes `first` and `second`: they end beyond the `bytes` that
    /// there are, or do not lie within one stride, so that one would lie in another element.
    #[allow(missing_docs)]
    Fields {
        first: usize,
        first_size: usize,
        second: usize,
        second_size: usize,
        stride: usize,
        len: usize,
        bytes: usize,
    },
}

impl StrideMismatch {
    #[inline]
    pub(crate) fn check_lengths(vectors: usize, codes: usize) -> Result<(), Self> {
        if vectors == codes { Ok(()) } else { Err(Self::Lengths { vectors, codes }) }
    }

    #[inline]
    pub(crate) fn check_frames(normals: usize, tangents: usize, codes: usize) -> Result<(), Self> {
        let fits = [normals, tangents] == [codes; 2];
        if fits { Ok(()) } else { Err(Self::Frames { normals, tangents, codes }) }
    }
}

impl fmt::Display for StrideMismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            StrideMismatch::Bounds { offset, stride, len, size, bytes } => write!(
                f,
                "{len} elements of {size} bytes from byte {offset} on, {stride} bytes apart, do not \
                 lie in {bytes} bytes"
            ),
            StrideMismatch::Stride { offset, stride, len, size, bytes } => write!(
                f,
                "a stride of {stride} bytes is less than an element's {size}, of {len} elements from byte \
                 {offset} on in {bytes} bytes"
            ),
            StrideMismatch::Lengths { vectors, codes } => {
                write!(f, "lengths differ: vectors {vectors}, codes {codes}")
            }
            StrideMismatch::Frames { normals, tangents, codes } => {
                write!(f, "lengths differ: normals {normals}, tangents {tangents}, codes {codes}")
            }
            StrideMismatch::Fields {
                first,
                first_size,
                second,
                second_size,
                stride,
                len,
                bytes,
            } => write!(
                f,
                "{len} elements with {first_size} bytes from byte {first} on and {second_size} from \
                 byte {second} on, {stride} bytes apart, do not lie in {bytes} bytes, each within a stride"
            ),
        }
    }
}

impl core::error::Error for StrideMismatch {}
