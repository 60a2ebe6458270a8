//! Debian's PostgreSQL, started in a temporary folder and gone with the process that started it.

use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Starts a server in the folder `$1` with the programs in `$2`, says so in a line, and stops it when its standard input ends: that
/// is when the tests have ended, however they did. Nobody but a plain user may run PostgreSQL.
const SCRIPT: &str = r#"
set -eu
plain=(env)
if [ "$(id -u)" = 0 ]; then
    plain=(setpriv --reuid=65534 --regid=65534 --clear-groups)
    chown 65534:65534 "$1"
fi
cd "$1"
"${plain[@]}" "$2/initdb" -D data -U voussoir --auth=trust --no-sync --no-locale -E UTF8 >initdb.log
"${plain[@]}" "$2/postgres" -D data -k "$1" -c listen_addresses= -c fsync=off -c max_connections=300 >postgres.log 2>&1 </dev/null &
server=$!
trap 'kill -QUIT $server; wait $server || true; cd /; rm -rf "$1"' EXIT
until "$2/pg_isready" -q -h "$1" -U voussoir -d postgres; do kill -0 $server; sleep 0.05; done
trap exit TERM INT HUP
echo ready
cat >/dev/null
"#;

/// Where PostgreSQL's own programs are.
fn programs() -> PathBuf {
    let versions = std::fs::read_dir("/usr/lib/postgresql").into_iter().flatten().flatten();
    let known = versions.map(|version| version.path().join("bin")).filter(|folder| folder.join("initdb").exists());
    let path = std::env::var_os("PATH").unwrap_or_default();
    let on_path = std::env::split_paths(&path).find(|folder| folder.join("initdb").exists());
    known.max().or(on_path).expect("these tests need PostgreSQL: on Debian, apt-get install postgresql")
}

/// The server, and the folder of its socket.
fn server() -> &'static Path {
    static SERVER: OnceLock<(PathBuf, Child)> = OnceLock::new();
    let (folder, _) = SERVER.get_or_init(|| {
        let folder = std::env::temp_dir().join(format!("voussoir-postgres-{}", std::process::id()));
        std::fs::create_dir(&folder).unwrap();
        let mut command = Command::new("bash");
        command.args(["-c", SCRIPT, "bash"]).arg(&folder).arg(programs());
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
        let mut said = [0; 5];
        child.stdout.take().unwrap().read_exact(&mut said).expect("PostgreSQL starts");
        assert_eq!(&said, b"ready");
        (folder, child)
    });
    folder
}

/// The address of a new, empty database.
pub fn database() -> String {
    static COUNT: AtomicUsize = AtomicUsize::new(0);
    let (folder, name) = (server(), format!("test{}", COUNT.fetch_add(1, Ordering::Relaxed)));
    let mut command = Command::new(programs().join("createdb"));
    let made = command.args(["-h"]).arg(folder).args(["-U", "voussoir", &name]).status().unwrap();
    assert!(made.success());
    format!("postgres://voussoir@localhost/{name}?host={}", folder.display())
}
