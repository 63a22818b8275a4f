//! The model's bits on this host, against those that are recorded (`BLESS=1` records them anew). The emulator and the
//! board are compared to the same record.

use std::path::Path;

#[test]
fn the_model_has_the_recorded_bits_on_this_host() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/parity.txt");
    let bits = format!("{:016x}\n", firmware::parity::hash());
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&path, &bits).unwrap();
    }
    assert_eq!(bits, std::fs::read_to_string(&path).unwrap());
}
