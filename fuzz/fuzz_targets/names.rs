//! A name is a format's in any ASCII case, and nothing else is.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unitpack::Format;

fuzz_target!(|data: &[u8]| {
    let name = &String::from_utf8_lossy(data);
    let fold = |s: &str| {
        s.bytes().map(|b| if b.is_ascii_uppercase() { b + 32 } else { b }).collect::<Vec<_>>()
    };
    let mut same = Format::ALL.iter().copied().filter(|f| fold(f.name()) == fold(name));
    let expected = same.next();
    assert_eq!(same.next(), None, "two formats are called {name:?}");
    assert_eq!(Format::from_name(name), expected, "{name:?}");
    match name.parse::<Format>() {
        Ok(format) => {
            assert_eq!(Some(format), expected, "{name:?}");
            assert_eq!(format.to_string(), format.name());
            let width = data.len() + 3;
            assert_eq!(format!("{format:>width$}"), format!("{:>width$}", format.name()));
        }
        Err(error) => {
            assert_eq!(expected, None, "{name:?}");
            assert!(error.to_string().contains("no format"), "{error}");
        }
    }
});
