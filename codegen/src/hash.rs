//! The hash that names what was made from texts.

/// Hash (hex) of a list of texts.
pub(crate) fn hash<'t>(texts: impl IntoIterator<Item = &'t str>) -> String {
    // A byte that no UTF-8 text has ends each text.
    let bytes = texts.into_iter().flat_map(|text| text.bytes().chain([0xff]));
    format!("{:032x}", fnv_1a(bytes))
}

/// FNV-1a, 128 bits.
fn fnv_1a(bytes: impl Iterator<Item = u8>) -> u128 {
    const START: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
    const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;
    bytes.fold(START, |hash, byte| (hash ^ u128::from(byte)).wrapping_mul(PRIME))
}

#[cfg(test)]
mod tests {
    use super::{fnv_1a, hash};

    #[test]
    fn the_hash_is_that_of_fnv_1a() {
        // The values that its authors publish (draft-eastlake-fnv).
        for (text, expected) in [
            ("", 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d),
            ("a", 0xd228_cb69_6f1a_8caf_7891_2b70_4e4a_8964),
            ("foobar", 0x343e_1662_793c_64bf_6f0d_3597_ba44_6f18),
        ] {
            assert_eq!(fnv_1a(text.bytes()), expected, "{text}");
        }
    }

    #[test]
    fn a_list_of_texts_has_a_hash_of_its_own() {
        let ends = |bytes: &[u8]| format!("{:032x}", fnv_1a(bytes.iter().copied()));
        assert_eq!(hash(["ab", "c"]), ends(b"ab\xffc\xff"));
        assert_ne!(hash(["ab", "c"]), hash(["a", "bc"]));
        assert_ne!(hash(["ab"]), hash(["ab", ""]));
    }
}
