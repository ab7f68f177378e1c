//! Writes the archive.

use super::{Content, Member, Members, SUMS};
use checkout::disk;
use checkout::failure::Failure;
use checkout::sums::Sums;
use files::write::{Draft, publish};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;
use tar::{Builder, EntryType, Header};

/// Writes the members and their list of sums into one archive, below the folder `top`, with dates `seconds` after 1970.
///
/// # Errors
/// A member cannot be read, or the archive not be written.
pub fn write(archive: &Path, top: &str, seconds: u64, members: &Members) -> Result<(), Failure> {
    let mut all = members.clone();
    let list = sums(members)?.to_text().into_bytes();
    all.insert(SUMS.to_owned(), Member { content: Content::Bytes(list), is_program: false });
    if let Some(folder) = archive.parent() {
        disk::create_folder(folder)?;
    }
    let draft = Draft::new(archive).map_err(Failure::failed)?;
    append_all(draft.path(), top, seconds, &all)?;
    publish(vec![draft]).map_err(Failure::failed)
}

fn append_all(file: &Path, top: &str, seconds: u64, members: &Members) -> Result<(), Failure> {
    let at = Failure::at(file);
    let mut builder = Builder::new(BufWriter::new(File::create(file).map_err(&at)?));
    for (name, member) in members {
        let bytes = bytes(member)?;
        let mut header = Header::new_gnu();
        header.set_entry_type(EntryType::Regular);
        header.set_mode(if member.is_program { 0o755 } else { 0o644 });
        header.set_uid(0);
        header.set_gid(0);
        header.set_mtime(seconds);
        header.set_size(bytes.len() as u64);
        builder.append_data(&mut header, format!("{top}/{name}"), &bytes[..]).map_err(&at)?;
    }
    let mut writer = builder.into_inner().map_err(&at)?;
    writer.flush().map_err(&at)?;
    writer.get_ref().sync_all().map_err(&at)
}

/// The sums of all members.
fn sums(members: &Members) -> Result<Sums, Failure> {
    let mut sums = Sums::default();
    for (name, member) in members {
        sums.by_name.insert(name.clone(), files::write::sha256(&bytes(member)?));
    }
    Ok(sums)
}

fn bytes(member: &Member) -> Result<Vec<u8>, Failure> {
    match &member.content {
        Content::File(path) => std::fs::read(path).map_err(Failure::at(path)),
        Content::Bytes(bytes) => Ok(bytes.clone()),
    }
}
