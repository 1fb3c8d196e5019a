//! The viewer tev, to which a picture is sent over TCP.

#[cfg(test)]
pub(super) mod testing;

use std::io;
use std::net::{TcpStream, ToSocketAddrs};
use std::time::Duration;

use tev_client::{PacketCreateImage, PacketUpdateImage, TevClient};

/// Time in which a viewer must answer, and take what it is sent.
const PATIENCE: Duration = Duration::from_secs(2);

/// Most numbers of one packet: 4 MiB.
const MOST_NUMBERS: usize = 1 << 20;

const CHANNELS: [&str; 3] = ["R", "G", "B"];

/// A connection to the viewer, in which a picture is open.
pub(super) struct Viewer {
    client: TevClient,
    name: String,
    width: u32,
}

impl Viewer {
    /// Connects to `HOST:PORT` and opens a black picture there.
    ///
    /// # Errors
    ///
    /// What the system says of the last address tried.
    pub(super) fn open(address: &str, name: &str, [width, height]: [u32; 2]) -> io::Result<Self> {
        let mut client = TevClient::wrap(connected(address)?);
        client.send(PacketCreateImage {
            image_name: name,
            grab_focus: false,
            width,
            height,
            channel_names: &CHANNELS,
        })?;
        Ok(Self {
            client,
            name: name.to_owned(),
            width,
        })
    }

    /// Sends every pixel, in stripes of rows.
    ///
    /// # Errors
    ///
    /// What the system says; the connection is of no use any more then.
    pub(super) fn send(&mut self, colours: &[[f32; 3]]) -> io::Result<()> {
        let width = self.width as usize;
        let rows = (MOST_NUMBERS / (CHANNELS.len() * width)).max(1);
        for (stripe, pixels) in colours.chunks(rows * width).enumerate() {
            self.client.send(PacketUpdateImage {
                image_name: &self.name,
                grab_focus: false,
                channel_names: &CHANNELS,
                channel_offsets: &[0, 1, 2],
                channel_strides: &[3; 3],
                x: 0,
                y: (stripe * rows) as u32,
                width: self.width,
                height: (pixels.len() / width) as u32,
                data: pixels.as_flattened(),
            })?;
        }
        Ok(())
    }
}

fn connected(address: &str) -> io::Result<TcpStream> {
    let mut last = io::Error::new(io::ErrorKind::NotFound, "no such host");
    for address in address.to_socket_addrs()? {
        match TcpStream::connect_timeout(&address, PATIENCE) {
            Ok(stream) => {
                stream.set_write_timeout(Some(PATIENCE))?;
                return Ok(stream);
            }
            Err(error) => last = error,
        }
    }
    Err(last)
}

#[cfg(test)]
mod tests {
    use std::net::TcpListener;

    use super::testing::received;
    use super::*;

    #[test]
    fn a_viewer_gets_every_pixel_in_its_place() {
        // Four stripes, the last one shorter.
        let [width, height] = [1000_u32, 1100];
        let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
        let address = listener.local_addr().expect("it is bound").to_string();
        let there = std::thread::spawn(move || {
            let (stream, _) = listener.accept().expect("a connection");
            received(stream)
        });
        let colours: Vec<[f32; 3]> = (0..width * height)
            .map(|pixel| [0, 1, 2].map(|channel| (pixel * 3 + channel) as f32))
            .collect();
        let mut viewer = Viewer::open(&address, "leaf", [width, height]).expect("it listens");
        // What comes later replaces what came before.
        let black = vec![[0.0; 3]; colours.len()];
        for picture in [&black, &colours] {
            viewer.send(picture).expect("it takes them");
        }
        drop(viewer);
        let (name, size, data) = there.join().expect("no panic");
        assert_eq!((name.as_str(), size), ("leaf", [width, height]));
        assert_eq!(data, colours.as_flattened());
    }

    #[test]
    fn a_viewer_that_is_not_there_or_goes_away_is_an_error() {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
        let address = listener.local_addr().expect("it is bound").to_string();
        let mut viewer = Viewer::open(&address, "leaf", [500, 500]).expect("it listens");
        let (stream, _) = listener.accept().expect("a connection");
        drop((stream, listener));
        let colours = vec![[0.5; 3]; 500 * 500];
        // The system may take the first packets before it notices.
        let sent = (0..100).find_map(|_| viewer.send(&colours).err());
        assert!(sent.is_some(), "nobody took a hundred pictures");
        let is_refused = |address| Viewer::open(address, "leaf", [5, 5]).is_err();
        assert!(is_refused(&address), "nobody listens");
        assert!(is_refused("no port"), "not an address");
    }

    #[test]
    fn a_viewer_that_takes_nothing_is_given_up() {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
        let address = listener.local_addr().expect("it is bound").to_string();
        let mut viewer = Viewer::open(&address, "leaf", [2000, 2000]).expect("it listens");
        let _stays_open = listener.accept().expect("a connection");
        let colours = vec![[0.5; 3]; 2000 * 2000];
        // More than buffers on the way hold: 48 MB each time.
        let started = std::time::Instant::now();
        let sent = (0..4).find_map(|_| viewer.send(&colours).err());
        assert!(sent.is_some(), "it was all taken by nobody");
        assert!(started.elapsed() < 10 * PATIENCE);
    }
}
