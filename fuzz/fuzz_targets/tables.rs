//! Decode tables, of every code and of one octant, give the bits that the codec gives.
#![no_main]

use std::cell::OnceCell;
use std::sync::OnceLock;

use libfuzzer_sys::fuzz_target;
use unitpack::Format;
use unitpack::decode_table::FormatTable;
use unitpack_fuzz::{Bytes, Subject};
use unitpack_test::codes::to_bytes;
use unitpack_test::tables::{AnyTable, Table, octant_tables, whole_tables};
use unitpack_test::vectors::bits;
use unitpack_test::{Arrays, UNWRITTEN};

/// A table, filled when first asked for.
struct Entry {
    table: AnyTable,
    filled: OnceCell<Box<dyn Table>>,
}

impl Entry {
    fn filled(&self) -> &dyn Table {
        let fill = || {
            let vectors = vec![[UNWRITTEN; 3]; self.table.len].leak();
            (self.table.fill)(vectors).expect("it is as long as the table")
        };
        &**self.filled.get_or_init(fill)
    }
}

thread_local! {
    static ENTRIES: Vec<Entry> = {
        let tables = octant_tables().into_iter().chain(whole_tables());
        tables.map(|table| Entry { table, filled: OnceCell::new() }).collect()
    };
}

/// The run-time table of a format, filled when first asked for.
fn format_table(format: Format) -> &'static FormatTable<'static> {
    static TABLES: [OnceLock<FormatTable>; 256] = [const { OnceLock::new() }; 256];
    TABLES[format as usize].get_or_init(|| {
        let len = FormatTable::len_for(format).expect("it has at most 16 bits");
        FormatTable::fill(format, vec![[UNWRITTEN; 3]; len].leak()).expect("it is as long")
    })
}

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes(data);
    ENTRIES.with(|entries| check(bytes.choose(entries), bytes));
});

fn check(entry: &Entry, mut bytes: Bytes<'_>) {
    let (format, table) = (entry.table.format, entry.filled());
    let count = bytes.length(100);
    let at = bytes.length(7);
    let codec = Subject::of(format);
    let codes = codec.codes(&mut bytes, count);
    let expected: Vec<_> = codes.iter().map(|&code| bits((codec.decode)(code))).collect();
    for (&code, expected) in codes.iter().zip(&expected) {
        assert_eq!(bits(table.decode(code)), *expected, "{format} {code:x}");
        assert_eq!(bits(format_table(format).decode(code as u16)), *expected, "{format} {code:x}");
    }
    let equal = |soa: &Arrays| soa.bits().eq(expected.iter().copied());
    if let Some(slices) = table.slices() {
        let mut soa = Arrays::unwritten([count; 3]);
        slices.decode_soa(&codes, soa.write()).unwrap();
        assert!(equal(&soa), "{format}: {soa:?}");

        for floats in [3, 4, 8] {
            let mut structures = vec![UNWRITTEN; floats * count];
            slices.decode_aos(&codes, floats, &mut structures).unwrap();
            for (structure, expected) in structures.chunks(floats).zip(&expected) {
                let (v, others) = structure.split_at(3);
                assert_eq!(v.iter().map(|c| c.to_bits()).collect::<Vec<_>>(), expected, "{format}");
                assert!(others.iter().all(|&c| c == UNWRITTEN), "{format} wrote {others:?}");
            }
        }
    }

    let mut bytes = vec![0xA5; at];
    bytes.extend(to_bytes(format, &codes));
    let mut soa = Arrays::unwritten([count; 3]);
    format_table(format).decode_bytes(&bytes[at..], soa.write()).unwrap();
    assert!(equal(&soa), "{format}, bytes from {at}: {soa:?}");
}
