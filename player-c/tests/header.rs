//! The header is what the code says. Written anew with `GAMBOL_HEADER=write cargo test -p gambol-player-c --test header`.

use std::{env, error::Error, fs, path::Path};

#[test]
fn the_header_is_that_of_the_code() -> Result<(), Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(folder.join("cbindgen.toml"))?;
    let mut header = Vec::new();
    cbindgen::generate_with_config(folder, config)?.write(&mut header);
    let path = folder.join("include/gambol_player.h");
    if env::var("GAMBOL_HEADER").is_ok_and(|what| what == "write") {
        fs::write(&path, &header)?;
    }
    assert_eq!(fs::read_to_string(&path)?, String::from_utf8(header)?, "{} is another", path.display());
    Ok(())
}
