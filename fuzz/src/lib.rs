//! What the targets share: how bytes become an input, and the codec that they choose.

use std::ops::Deref;
use std::sync::{LazyLock, OnceLock};

use unitpack::frame::{Frame, FrameSoa, FrameSoaMut};
use unitpack::{Format, Soa, SoaMut};
use unitpack_test::codes::last_pattern;
use unitpack_test::oracle::{Oracle, oracle};
use unitpack_test::vectors::bits;
use unitpack_test::{AnyCodec, Code, Elements, Transcode, Typed, UNWRITTEN, Vector, transcodes};

/// Angle that is put down to the rounding of f32, in radians.
pub const ROUNDING: f64 = 3e-7;

/// What is left of the input.
pub struct Bytes<'a>(pub &'a [u8]);

impl Bytes<'_> {
    /// The next ones; zeros after the end.
    pub fn take<const N: usize>(&mut self) -> [u8; N] {
        let (now, later) = self.0.split_at(self.0.len().min(N));
        self.0 = later;
        std::array::from_fn(|i| now.get(i).copied().unwrap_or(0))
    }

    /// The next one.
    pub fn byte(&mut self) -> u8 {
        self.take::<1>()[0]
    }

    /// A number from 0 to `most`.
    pub fn length(&mut self, most: usize) -> usize {
        usize::from(self.byte()) % (most + 1)
    }

    /// The next four, as a float.
    pub fn float(&mut self) -> f32 {
        f32::from_le_bytes(self.take())
    }

    /// One of them.
    pub fn choose<'t, T>(&mut self, from: &'t [T]) -> &'t T {
        &from[usize::from(self.byte()) % from.len()]
    }

    /// All that is left, in pieces of `N` bytes; a part of one is filled with zeros.
    pub fn rest<const N: usize>(&mut self) -> Vec<[u8; N]> {
        let count = self.0.len().div_ceil(N);
        (0..count).map(|_| self.take()).collect()
    }

    /// So many items from what is left: each from `N` bytes and the number of the turn, as the
    /// bytes are taken over again where there are too few.
    fn items<T, const N: usize>(
        &mut self,
        count: usize,
        item: impl Fn([u8; N], usize) -> T,
    ) -> Vec<T> {
        let mut given = self.rest::<N>();
        given.resize(given.len().max(1), [0x3F; N]);
        (0..count).map(|i| item(given[i % given.len()], i / given.len())).collect()
    }
}

/// Elements of `size` bytes: mostly near, some where sizes overflow.
pub fn choose_elements(bytes: &mut Bytes<'_>, size: usize) -> Elements {
    let mut number = |near: usize| match bytes.byte() {
        0 => usize::MAX,
        1 => usize::MAX / 2,
        2 => 1 << (usize::BITS / 2),
        byte => near + usize::from(byte % 8),
    };
    let [offset, stride, len] = [number(0), number(size - 1), number(0)];
    Elements { offset, stride, len: if len < 8 { 3 * len } else { len } }
}

/// Whether they lie in so many bytes, in more bits than sizes have.
pub fn lie_in(elements: Elements, size: usize, bytes: usize) -> bool {
    let Elements { offset, stride, len } = elements;
    let [offset, stride, len, size, bytes] = [offset, stride, len, size, bytes].map(|n| n as u128);
    len == 0 || stride >= size && (offset + (len - 1) * stride + size <= bytes)
}

/// Frames as a structure of arrays: normals, tangents and handednesses.
#[derive(Clone, PartialEq, Debug)]
pub struct FrameArrays(pub [Vec<f32>; 7]);

impl FrameArrays {
    /// Arrays of these lengths, filled with [`UNWRITTEN`].
    pub fn unwritten(lengths: [usize; 7]) -> Self {
        FrameArrays(lengths.map(|length| vec![UNWRITTEN; length]))
    }

    /// To encode from.
    pub fn read(&self) -> FrameSoa<'_> {
        let [nx, ny, nz, tx, ty, tz, handedness] = &self.0;
        let (normal, tangent) = (Soa { x: nx, y: ny, z: nz }, Soa { x: tx, y: ty, z: tz });
        FrameSoa { normal, tangent, handedness }
    }

    /// To decode to.
    pub fn write(&mut self) -> FrameSoaMut<'_> {
        let [nx, ny, nz, tx, ty, tz, handedness] = &mut self.0;
        let (normal, tangent) = (SoaMut { x: nx, y: ny, z: nz }, SoaMut { x: tx, y: ty, z: tz });
        FrameSoaMut { normal, tangent, handedness }
    }
}

impl From<&[Frame]> for FrameArrays {
    fn from(frames: &[Frame]) -> Self {
        FrameArrays([0, 1, 2, 3, 4, 5, 6].map(|i| {
            let component = |f: &Frame| match i {
                0..3 => f.normal[i],
                3..6 => f.tangent[i - 3],
                _ => f.handedness,
            };
            frames.iter().map(component).collect()
        }))
    }
}

/// A codec and what is right for it. Its functions are compiled here, and not for every target.
pub struct Subject {
    codec: &'static AnyCodec,
    typed: &'static Typed,
    oracle: OnceLock<Oracle>,
}

impl Deref for Subject {
    type Target = AnyCodec;
    fn deref(&self) -> &AnyCodec {
        self.codec
    }
}

impl Subject {
    /// The next byte chooses.
    pub fn choose(bytes: &mut Bytes<'_>) -> &'static Subject {
        Self::of(*bytes.choose(Format::ALL))
    }

    /// That of a format.
    pub fn of(format: Format) -> &'static Subject {
        static ALL: LazyLock<Vec<Subject>> = LazyLock::new(|| {
            let subject = |&format: &Format| Subject {
                codec: AnyCodec::of(format),
                typed: Typed::beside(format),
                oracle: OnceLock::new(),
            };
            Format::ALL.iter().map(subject).collect()
        });
        &ALL[format as usize]
    }

    /// The functions of slices that only a codec's type has: those of a format of this family and
    /// width of code.
    pub fn typed(&self) -> &'static Typed {
        self.typed
    }

    /// The next byte chooses a transcoder: from or to [`typed`](Subject::typed), or between any two
    /// types of code.
    pub fn transcode(&self, bytes: &mut Bytes<'_>) -> &'static Transcode {
        static ALL: LazyLock<Vec<Transcode>> = LazyLock::new(transcodes);
        let own = &self.typed.transcode;
        let i = bytes.length(own.len() + ALL.len() - 1);
        own.get(i).unwrap_or_else(|| &ALL[i - own.len()])
    }

    /// Its oracle.
    pub fn oracle(&self) -> &Oracle {
        self.oracle.get_or_init(|| oracle(self.format.name()))
    }

    /// `count` vectors from what is left: of any bits, of any direction, or about half way between
    /// two codes.
    pub fn vectors(&self, bytes: &mut Bytes<'_>, count: usize) -> Vec<Vector> {
        let kind = bytes.byte() % 3;
        bytes.items(count, |item: [u8; 12], turn| {
            let mut v: Vector = match kind {
                0 => bytemuck::cast(item),
                1 => bytemuck::cast::<_, [i32; 3]>(item).map(|i| i as f32 / 2f32.powi(31)),
                _ => {
                    let code = u128::from_le_bytes(std::array::from_fn(|i| item[i % 12]));
                    let other = code ^ 1 << (u32::from(item[11]) % self.format.bits());
                    let [v, w] = [code, other].map(self.decode);
                    [v[0] + w[0], v[1] + w[1], v[2] + w[2]]
                }
            };
            // No two turns give the same.
            v.rotate_left(turn % 3);
            if turn / 3 % 2 == 1 { v.map(|c| -c) } else { v }
        })
    }

    /// `count` codes from what is left: of any bits, or that of a vector with one bit changed.
    pub fn codes(&self, bytes: &mut Bytes<'_>, count: usize) -> Vec<Code> {
        let near = bytes.byte() % 2 == 1;
        let mask = last_pattern(self.format);
        if near {
            bytes.items(count, |item: [u8; 13], turn| {
                let v = bytemuck::pod_read_unaligned(&item[..12]);
                let bit = (usize::from(item[12]) + turn) % self.format.bits() as usize;
                (self.encode)(v) ^ 1 << bit
            })
        } else {
            // As many bytes as a code has, so that a dictionary's fit.
            let size = self.format.code_size();
            let given: Vec<Code> = bytes.0.chunks(size).map(integer_of).chain([1]).collect();
            let mixed = |turn| turn as Code * 0x9E37_79B9_7F4A_7C15_F39C;
            let code = |i| given[i % given.len()] ^ mixed(i / given.len()) & mask;
            (0..count).map(code).collect()
        }
    }

    /// How many vectors, up to a hundred: a block and a bit where the precise search takes
    /// up to 200 us for one and not 10.
    pub fn count(&self, bytes: &mut Bytes<'_>) -> usize {
        bytes.length(if self.is_finer_than_f32() { 18 } else { 100 })
    }

    /// Stops unless an encoder gives this very code for what it decodes to.
    pub fn check_canonical(&self, code: Code) {
        let format = self.format;
        let decoded = (self.decode)(code);
        let again = (self.encode_precise)(decoded);
        if self.is_finer_than_f32() {
            let alike = (self.decode)(again);
            assert_eq!(bits(alike), bits(decoded), "{format} {code:x} became {again:x}");
            let third = (self.encode_precise)(alike);
            assert_eq!(third, again, "{format} {code:x} became {again:x}, then {third:x}");
        } else {
            assert_eq!(again, code, "{format} {code:x}, which is {decoded:?}, became {again:x}");
        }
    }
}

/// At most sixteen bytes.
fn integer_of(bytes: &[u8]) -> Code {
    bytes.iter().rev().fold(0, |code, &byte| code << 8 | Code::from(byte))
}
