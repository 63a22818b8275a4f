//! Inputs that are small and would unpack to more than a machine holds.

use std::fs;
use std::io;

use super::fault::Fault;
use super::outcome::{Outcome, refused};
use super::recording_bytes::{
    Codec, Page, bag, bag_message_head, gzip, lz4, lz4_unpacks_to, mcap, mcap_message_head, parquet, zstd,
    zstd_unpacks_to,
};
use super::scene::Scene;

/// The faults.
pub const FAULTS: &[Fault] = &[
    Fault { what: "bomb: MCAP, a chunk of zstd that unpacks to 2 GB and says so", inject: mcap_zstd },
    Fault { what: "bomb: MCAP, a chunk of zstd that unpacks to 2 GB and says 1 MB", inject: mcap_zstd_that_lies },
    Fault { what: "bomb: MCAP, a chunk of lz4 that unpacks to 1 GB and says so", inject: mcap_lz4 },
    Fault { what: "bomb: MCAP, a chunk of lz4 that unpacks to 1 GB and says 1 MB", inject: mcap_lz4_that_lies },
    Fault { what: "bomb: ROS 1, a chunk of lz4 that unpacks to 1 GB and says so", inject: bag_lz4 },
    Fault { what: "bomb: ROS 1, a chunk of lz4 that unpacks to 1 GB and says 1 MB", inject: bag_lz4_that_lies },
    Fault { what: "bomb: Parquet, a page of zstd that unpacks to 1 GB and says so", inject: parquet_zstd },
    Fault { what: "bomb: Parquet, a page of zstd that unpacks to 1 GB and says 1 MB", inject: parquet_zstd_that_lies },
    Fault { what: "bomb: Parquet, a page of gzip that unpacks to 1 GB and says 1 MB", inject: parquet_gzip_that_lies },
    Fault { what: "bomb: Parquet, a page of eight bytes with two billion equal rows", inject: parquet_rows },
    Fault { what: "bomb: Parquet, the same in the table of a fleet's sessions", inject: parquet_rows_of_a_fleet },
    Fault { what: "bomb: a packed game log with a packet of 200 MB", inject: a_long_packet },
    Fault { what: "bomb: a packed game log with twelve million records of nothing", inject: many_records },
    Fault {
        what: "bomb: names that stand for lists of names, nine deep, in a split recording's list",
        inject: aliases,
    },
    Fault { what: "bomb: a list of lists, fifty thousand deep, there", inject: deep_list },
];

/// Of the columns of a run's table.
const COLUMNS: [&str; 5] = ["t_s", "w0_rad_s", "w1_rad_s", "w2_rad_s", "w3_rad_s"];

/// What a chunk or page of 1 MB says of itself.
const SAID: u64 = 1 << 20;

/// Memory that a bomb may take \[MB\]: a record or chunk may have 16 MB, whatever the file's length.
const MOST_MB: f64 = 150.0;

/// Checks a session whose one run is this file, which has to be refused with its name.
fn recorded(scene: &Scene, name: &str, bytes: &[u8], says: &str) -> io::Result<Outcome> {
    fs::remove_dir_all(scene.at("session/runs"))?;
    let file = format!("session/runs/{name}");
    scene.write(&file, bytes)?;
    let outcome = refused(scene, &scene.check().within(MOST_MB), &[&file, says])?;
    Ok(outcome.noting(&format!("a file of {:.1} kB", bytes.len() as f64 / 1e3)))
}

/// Of blocks of 128 kB.
const GB: usize = 8192;

fn mcap_zstd(scene: &Scene) -> io::Result<Outcome> {
    let head = mcap_message_head(((2 * GB) << 17) as u64);
    recorded(
        scene,
        "a.mcap",
        &mcap("zstd", zstd_unpacks_to(&head, 2 * GB), &zstd(&head, 2 * GB)),
        "cannot be read as MCAP",
    )
}

fn mcap_zstd_that_lies(scene: &Scene) -> io::Result<Outcome> {
    let head = mcap_message_head(((2 * GB) << 17) as u64);
    recorded(scene, "a.mcap", &mcap("zstd", SAID, &zstd(&head, 2 * GB)), "cannot be read as MCAP")
}

fn mcap_lz4(scene: &Scene) -> io::Result<Outcome> {
    let head = mcap_message_head(256 << 22);
    recorded(scene, "a.mcap", &mcap("lz4", lz4_unpacks_to(&head, 256), &lz4(&head, 256)), "cannot be read as MCAP")
}

fn mcap_lz4_that_lies(scene: &Scene) -> io::Result<Outcome> {
    let head = mcap_message_head(256 << 22);
    recorded(scene, "a.mcap", &mcap("lz4", SAID, &lz4(&head, 256)), "cannot be read as MCAP")
}

fn bag_lz4(scene: &Scene) -> io::Result<Outcome> {
    let head = bag_message_head(256 << 22);
    let said = u32::try_from(lz4_unpacks_to(&head, 256)).map_err(io::Error::other)?;
    recorded(scene, "a.bag", &bag("lz4", said, &lz4(&head, 256)), "cannot be read as a ROS 1 recording")
}

fn bag_lz4_that_lies(scene: &Scene) -> io::Result<Outcome> {
    let head = bag_message_head(256 << 22);
    recorded(scene, "a.bag", &bag("lz4", SAID as u32, &lz4(&head, 256)), "cannot be read as a ROS 1 recording")
}

fn page(bytes: Vec<u8>, unpacks_to: u64) -> Page {
    Page { bytes, unpacks_to, values: unpacks_to / 8, dictionary: [false; 2] }
}

fn parquet_zstd(scene: &Scene) -> io::Result<Outcome> {
    let file = parquet(&COLUMNS, Codec::Zstd, &[page(zstd(&[0; 8], GB), zstd_unpacks_to(&[0; 8], GB))]);
    recorded(scene, "a.parquet", &file, "says that it unpacks to")
}

fn parquet_zstd_that_lies(scene: &Scene) -> io::Result<Outcome> {
    let file = parquet(&COLUMNS, Codec::Zstd, &[page(zstd(&[0; 8], GB), SAID)]);
    recorded(scene, "a.parquet", &file, "cannot be read as Parquet")
}

fn parquet_gzip_that_lies(scene: &Scene) -> io::Result<Outcome> {
    let file = parquet(&COLUMNS, Codec::Gzip, &[page(gzip(&[0; 8], 4_000_000), SAID)]);
    recorded(scene, "a.parquet", &file, "says that it unpacks to 1048576 bytes, and has more")
}

/// One number, and a page that names it two billion times: a run of the index 0, one bit wide.
fn equal_rows(names: &[&str]) -> Vec<u8> {
    let values = i32::MAX as u64;
    let times = values << 1;
    let run = (0..5).map(|k| (times >> (7 * k)) as u8 & 0x7f | if k < 4 { 0x80 } else { 0 });
    let indices: Vec<u8> = [1].into_iter().chain(run).chain([0]).collect();
    let dictionary = Page { bytes: vec![0; 8], unpacks_to: 8, values: 1, dictionary: [true, false] };
    let data = Page { unpacks_to: indices.len() as u64, bytes: indices, values, dictionary: [false, true] };
    parquet(names, Codec::Plain, &[dictionary, data])
}

fn parquet_rows(scene: &Scene) -> io::Result<Outcome> {
    recorded(scene, "a.parquet", &equal_rows(&COLUMNS), "rows or more")
}

fn parquet_rows_of_a_fleet(scene: &Scene) -> io::Result<Outcome> {
    let file = "season/sessions/robot=r01/date=2026-11-01/part.parquet";
    scene.write(file, &equal_rows(&["rows", "duration_s"]))?;
    refused(scene, &scene.asked(&["fleet", "report", "season"]).within(MOST_MB), &[file, "rows or more"])
}

/// What a game log begins with.
const LOG: &[u8] = b"SSL_LOG_FILE\0\0\0\x01";

const MAPPING: &[u8] = b"topic = \"yellow/3\"\n\n[columns]\nx_m = { from = \"x\", unit = \"mm\" }\n\
    y_m = { from = \"y\", unit = \"mm\" }\ntheta_rad = { from = \"orientation\" }\n";

fn a_long_packet(scene: &Scene) -> io::Result<Outcome> {
    scene.write("session/columns.toml", MAPPING)?;
    let head = [LOG, &[0; 8], &4_i32.to_be_bytes(), &200_000_000_i32.to_be_bytes()].concat();
    recorded(scene, "a.log.gz", &gzip(&head, 800_000), "states a size of 200000000 bytes")
}

fn many_records(scene: &Scene) -> io::Result<Outcome> {
    scene.write("session/columns.toml", MAPPING)?;
    recorded(scene, "a.log.gz", &gzip(LOG, 800_000), "")
}

fn listed(scene: &Scene, text: &str) -> io::Result<Outcome> {
    scene.write("session/runs/drive/metadata.yaml", text.as_bytes())?;
    refused(scene, &scene.check(), &["runs/drive/metadata.yaml: ", "ros2 bag reindex"])
}

fn aliases(scene: &Scene) -> io::Result<Outcome> {
    let ten = |name: &str| [name; 10].join(",");
    let line = |k: usize| format!("a{k}: &a{k} [{}]\n", ten(&format!("*a{}", k - 1)));
    listed(scene, &(format!("a0: &a0 [{}]\n", ten("x")) + &(1..9).map(line).collect::<String>()))
}

fn deep_list(scene: &Scene) -> io::Result<Outcome> {
    listed(scene, &"- ".repeat(50_000))
}
