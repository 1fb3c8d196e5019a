//! The viewer's side, for tests.

use std::io::Read as _;
use std::net::TcpStream;

use super::CHANNELS;

/// Numbers and texts of a packet, as the protocol of tev has them: little-endian, texts ended
/// by a zero.
struct Packet(Vec<u8>, usize);

impl Packet {
    /// The next packet; `None` at the end of the stream.
    fn next(stream: &mut TcpStream) -> Option<Self> {
        let mut length = [0; 4];
        stream.read_exact(&mut length).ok()?;
        let mut rest = vec![0; u32::from_le_bytes(length) as usize - 4];
        stream.read_exact(&mut rest).expect("a whole packet");
        Some(Self(rest, 0))
    }

    fn bytes<const N: usize>(&mut self) -> [u8; N] {
        let bytes = self.0[self.1..self.1 + N].try_into().expect("so many");
        self.1 += N;
        bytes
    }

    fn word(&mut self) -> u32 {
        u32::from_le_bytes(self.bytes())
    }

    fn text(&mut self) -> String {
        let rest = &self.0[self.1..];
        let end = rest.iter().position(|byte| *byte == 0).expect("a zero");
        self.1 += end + 1;
        String::from_utf8(rest[..end].to_vec()).expect("text")
    }

    fn channels(&mut self) -> usize {
        let count = self.word();
        let names: Vec<String> = (0..count).map(|_| self.text()).collect();
        assert_eq!(names, CHANNELS);
        names.len()
    }
}

/// The picture that a viewer has after all packets of a stream.
pub(in crate::cli::render) fn received(mut stream: TcpStream) -> (String, [u32; 2], Vec<f32>) {
    let mut create = Packet::next(&mut stream).expect("a packet that opens the picture");
    assert_eq!(create.bytes::<2>(), [4, 0], "CreateImage, without focus");
    let name = create.text();
    let (width, height) = (create.word(), create.word());
    assert_eq!(create.channels(), 3);
    assert_eq!(create.1, create.0.len());
    let mut data = vec![f32::NAN; (width * height * 3) as usize];
    while let Some(mut update) = Packet::next(&mut stream) {
        assert_eq!(update.bytes::<2>(), [6, 0], "UpdateImageV3, without focus");
        assert_eq!(update.text(), name);
        let count = update.channels();
        let [x, y, wide, high] = [(); 4].map(|()| update.word());
        assert_eq!((x, wide), (0, width));
        let [offsets, strides] = [(); 2].map(|()| {
            let numbers = (0..count).map(|_| u64::from_le_bytes(update.bytes()));
            numbers.collect::<Vec<_>>()
        });
        assert_eq!((offsets, strides), (vec![0, 1, 2], vec![3; 3]));
        let first = (y * width * 3) as usize;
        for number in &mut data[first..first + (wide * high * 3) as usize] {
            *number = f32::from_le_bytes(update.bytes());
        }
        assert_eq!(update.1, update.0.len());
    }
    (name, [width, height], data)
}
