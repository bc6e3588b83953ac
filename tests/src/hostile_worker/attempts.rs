//! What native code could try, system call by system call, and which layer refuses it.

use std::io;
use std::net::{Ipv4Addr, TcpStream};
use std::os::linux::net::SocketAddrExt as _;
use std::os::unix::net::{SocketAddr, UnixStream};

use crate::errand::Errand;
use crate::system_call::{address, address_of, call, forked, path};
use crate::worker::seal::Layer::{self, Descriptors, Files, Limits, Network, Session, SystemCalls};

/// One thing that is tried.
pub(crate) struct Attempt {
    pub(crate) name: &'static str,
    /// The layers that refuse it, each by itself.
    pub(crate) alone: &'static [Layer],
    /// More of them, which refuse it to an ordinary user and not to root.
    pub(crate) for_users: &'static [Layer],
    /// Whether it works in a process that is not sealed.
    pub(crate) unsealed: Unsealed,
    pub(crate) make: fn(&Errand) -> io::Result<String>,
}

/// Whether an attempt works in a process that is not sealed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Unsealed {
    Works,
    /// Not on every machine, or not for every user: a refusal shows little there.
    MayWork,
    /// It is not tried: it would harm the test.
    Never,
}

const fn attempt(
    name: &'static str,
    alone: &'static [Layer],
    make: fn(&Errand) -> io::Result<String>,
) -> Attempt {
    Attempt {
        name,
        alone,
        for_users: &[],
        unsealed: Unsealed::Works,
        make,
    }
}

impl Attempt {
    const fn may_work(self) -> Self {
        Self {
            unsealed: Unsealed::MayWork,
            ..self
        }
    }

    const fn never_unsealed(self) -> Self {
        Self {
            unsealed: Unsealed::Never,
            ..self
        }
    }

    const fn for_users(self, layers: &'static [Layer]) -> Self {
        Self {
            for_users: layers,
            ..self
        }
    }
}

/// The folder in which a path without a beginning starts.
const HERE: usize = libc::AT_FDCWD as usize;
const PAGE: usize = 4096;
const GIGABYTE: usize = 1 << 30;
const CHILD: usize = libc::SIGCHLD as usize;
/// A signal that nobody notices who does not wait for it.
const UNNOTICED: usize = libc::SIGCONT as usize;

fn done(returned: io::Result<usize>) -> io::Result<String> {
    returned.map(|value| value.to_string())
}

fn refused(why: &str) -> io::Error {
    io::Error::other(why.to_owned())
}

fn open(file: &str, flags: i32) -> io::Result<usize> {
    let file = path(file);
    call(
        libc::SYS_openat,
        [HERE, file.as_ptr() as usize, flags as usize, 0o600],
    )
}

fn read(descriptor: usize) -> io::Result<String> {
    let mut bytes = [0_u8; 64];
    let length = call(
        libc::SYS_read,
        [descriptor, bytes.as_mut_ptr() as usize, bytes.len()],
    )?;
    Ok(String::from_utf8_lossy(&bytes[..length]).into_owned())
}

fn read_file(file: &str) -> io::Result<String> {
    read(open(file, libc::O_RDONLY)?)
}

fn socket(family: i32, kind: i32) -> io::Result<usize> {
    call(libc::SYS_socket, [family as usize, kind as usize, 0])
}

/// A call with one path of the errand's folder.
fn on_file(errand: &Errand, number: libc::c_long, more: [usize; 3]) -> io::Result<String> {
    let file = path(&errand.file());
    let [a, b, c] = more;
    done(call(number, [HERE, file.as_ptr() as usize, a, b, c]))
}

/// A call that makes a second name in the errand's folder.
fn second_name(errand: &Errand, number: libc::c_long) -> io::Result<String> {
    let (old, new) = (
        path(&errand.file()),
        path(&format!("{}/new", errand.folder)),
    );
    let (old, new) = (old.as_ptr() as usize, new.as_ptr() as usize);
    done(call(number, [HERE, old, HERE, new, 0]))
}

fn clone(flags: usize) -> io::Result<String> {
    forked(|| call(libc::SYS_clone, [flags | CHILD, 0, 0, 0, 0]))
}

fn execute(file: &str) -> io::Result<String> {
    let file = path(file);
    let words = [file.as_ptr() as usize, 0];
    let nothing = [0_usize];
    done(call(
        libc::SYS_execve,
        [file.as_ptr() as usize, address(&words), address(&nothing)],
    ))
}

fn map(length: usize, protection: i32) -> io::Result<usize> {
    let flags = libc::MAP_PRIVATE | libc::MAP_ANONYMOUS | libc::MAP_NORESERVE;
    call(
        libc::SYS_mmap,
        [
            0,
            length,
            protection as usize,
            flags as usize,
            usize::MAX,
            0,
        ],
    )
}

const DATA: i32 = libc::PROT_READ | libc::PROT_WRITE;
const CODE: i32 = libc::PROT_READ | libc::PROT_EXEC;

/// Sets a limit of this process, or of another, to more than a sealed one has.
fn raise(process: usize) -> io::Result<String> {
    let limit = [1_u64 << 20; 2];
    let which = libc::RLIMIT_FSIZE as usize;
    done(call(
        libc::SYS_prlimit64,
        [process, which, address(&limit), 0],
    ))
}

/// A limit of this process: soft and hard.
fn limit(which: u32) -> io::Result<[u64; 2]> {
    let mut limit = [0_u64; 2];
    call(
        libc::SYS_prlimit64,
        [0, which as usize, 0, address_of(&mut limit)],
    )?;
    Ok(limit)
}

fn control(what: i32, argument: usize) -> io::Result<usize> {
    call(libc::SYS_prctl, [what as usize, argument, 0, 0, 0])
}

/// The variables that a worker has: settings of its two allocators.
const OF_ALLOCATORS: [&str; 3] = [
    "MIMALLOC_ARENA_RESERVE",
    "MIMALLOC_ARENA_EAGER_COMMIT",
    "MALLOC_ARENA_MAX",
];

/// All of it, by what it is after.
pub(crate) const ATTEMPTS: &[Attempt] = &[
    // --- files
    attempt(
        "read a file of the system",
        &[Files, Limits, SystemCalls],
        |_| read_file("/etc/passwd"),
    ),
    attempt(
        "read a file of its own user",
        &[Files, Limits, SystemCalls],
        |errand| read_file(&errand.file()),
    ),
    attempt(
        "read its first environment",
        &[Files, Limits, SystemCalls],
        |_| read_file("/proc/self/environ"),
    ),
    attempt(
        "read the grader's environment",
        &[Files, Limits, SystemCalls],
        |errand| read_file(&format!("/proc/{}/environ", errand.grader)),
    )
    .may_work(),
    attempt(
        "open the grader's memory",
        &[Files, Limits, SystemCalls],
        |errand| done(open(&format!("/proc/{}/mem", errand.grader), libc::O_RDWR)),
    )
    .may_work(),
    attempt(
        "list a folder of the checkout",
        &[Files, Limits, SystemCalls],
        |errand| {
            let folder = open(&errand.checkout, libc::O_RDONLY | libc::O_DIRECTORY)?;
            let mut entries = [0_u8; 4096];
            let entries = [folder, entries.as_mut_ptr() as usize, entries.len()];
            done(call(libc::SYS_getdents64, entries))
        },
    ),
    attempt("list the processes", &[Files, Limits, SystemCalls], |_| {
        done(open("/proc", libc::O_RDONLY | libc::O_DIRECTORY))
    }),
    attempt(
        "open a file by openat2",
        &[Files, Limits, SystemCalls],
        |errand| {
            let (file, how) = (path(&errand.file()), [0_u64; 3]);
            let arguments = [HERE, file.as_ptr() as usize, address(&how), 24];
            done(call(libc::SYS_openat2, arguments))
        },
    ),
    attempt(
        "name a file without reading it",
        &[Limits, SystemCalls],
        |errand| done(open(&errand.file(), libc::O_PATH)),
    ),
    attempt("create a file", &[Files, Limits, SystemCalls], |errand| {
        let file = format!("{}/new", errand.folder);
        done(open(&file, libc::O_WRONLY | libc::O_CREAT))
    }),
    attempt(
        "create a file without a name",
        &[Files, Limits, SystemCalls],
        |errand| done(open(&errand.folder, libc::O_RDWR | libc::O_TMPFILE)),
    )
    .may_work(),
    attempt("empty a file", &[Files, Limits, SystemCalls], |errand| {
        done(open(&errand.file(), libc::O_WRONLY | libc::O_TRUNC))
    }),
    attempt("shorten a file", &[SystemCalls], |errand| {
        let file = path(&errand.file());
        done(call(libc::SYS_truncate, [file.as_ptr() as usize, 0]))
    }),
    attempt("create a folder", &[Files, SystemCalls], |errand| {
        let folder = path(&format!("{}/new", errand.folder));
        done(call(
            libc::SYS_mkdirat,
            [HERE, folder.as_ptr() as usize, 0o700],
        ))
    }),
    attempt(
        "create a pipe with a name",
        &[Files, SystemCalls],
        |errand| {
            let pipe = path(&format!("{}/new", errand.folder));
            let kind = (libc::S_IFIFO | 0o600) as usize;
            done(call(
                libc::SYS_mknodat,
                [HERE, pipe.as_ptr() as usize, kind, 0],
            ))
        },
    ),
    attempt("create a link", &[Files, SystemCalls], |errand| {
        let (to, link) = (path("/etc"), path(&format!("{}/new", errand.folder)));
        let arguments = [to.as_ptr() as usize, HERE, link.as_ptr() as usize];
        done(call(libc::SYS_symlinkat, arguments))
    }),
    attempt(
        "give a file a second name",
        &[Files, SystemCalls],
        |errand| second_name(errand, libc::SYS_linkat),
    ),
    attempt("rename a file", &[Files, SystemCalls], |errand| {
        second_name(errand, libc::SYS_renameat2)
    }),
    attempt("remove a file", &[Files, SystemCalls], |errand| {
        on_file(errand, libc::SYS_unlinkat, [0; 3])
    }),
    attempt("remove a folder", &[Files, SystemCalls], |errand| {
        let folder = path(&format!("{}/gone", errand.folder));
        let arguments = [HERE, folder.as_ptr() as usize, libc::AT_REMOVEDIR as usize];
        done(call(libc::SYS_unlinkat, arguments))
    }),
    attempt("look at a file by statx", &[SystemCalls], |errand| {
        let mut about = [0_u64; 32];
        on_file(errand, libc::SYS_statx, [0, 0xfff, address_of(&mut about)])
    }),
    attempt("look whether a file is there", &[SystemCalls], |errand| {
        on_file(errand, libc::SYS_faccessat, [0; 3])
    }),
    attempt("read where a link leads", &[SystemCalls], |_| {
        let (link, mut to) = (path("/proc/self/exe"), [0_u8; 256]);
        let to = [HERE, link.as_ptr() as usize, to.as_mut_ptr() as usize, 256];
        done(call(libc::SYS_readlinkat, to))
    }),
    attempt("change who may read a file", &[SystemCalls], |errand| {
        on_file(errand, libc::SYS_fchmodat, [0o777, 0, 0])
    }),
    attempt("change the times of a file", &[SystemCalls], |errand| {
        on_file(errand, libc::SYS_utimensat, [0; 3])
    }),
    attempt("change its folder", &[SystemCalls], |errand| {
        let folder = path(&errand.folder);
        done(call(libc::SYS_chdir, [folder.as_ptr() as usize]))
    }),
    attempt(
        "stay in the folder of the grader",
        &[Session, SystemCalls],
        |_| {
            let mut folder = [0_u8; 1024];
            let length = call(libc::SYS_getcwd, [folder.as_mut_ptr() as usize, 1024])?;
            let folder = String::from_utf8_lossy(&folder[..length.saturating_sub(1)]);
            match folder.as_ref() {
                "/" => Err(refused("it is in the root")),
                folder => Ok(folder.to_owned()),
            }
        },
    ),
    attempt("watch files", &[Limits, SystemCalls], |_| {
        done(call(libc::SYS_inotify_init1, [0]))
    }),
    attempt("mount a file system", &[Files, SystemCalls], |errand| {
        let (kind, at) = (path("tmpfs"), path(&errand.folder));
        let (kind, at) = (kind.as_ptr() as usize, at.as_ptr() as usize);
        done(call(libc::SYS_mount, [kind, at, kind, 0, 0]))
    })
    .never_unsealed(),
    attempt("change the root", &[SystemCalls], |errand| {
        let folder = path(&errand.folder);
        done(call(libc::SYS_chroot, [folder.as_ptr() as usize]))
    })
    .may_work(),
    // --- what it has inherited
    attempt(
        "read a descriptor that was left open",
        &[Descriptors],
        |errand| read(errand.descriptor),
    ),
    attempt(
        "write to a descriptor that was left open",
        &[Descriptors, Limits],
        |errand| {
            let text = "words";
            let arguments = [errand.descriptor, text.as_ptr() as usize, text.len()];
            done(call(libc::SYS_write, arguments))
        },
    ),
    attempt(
        "make a copy of a descriptor",
        &[Limits, SystemCalls],
        |_| done(call(libc::SYS_dup, [0])),
    ),
    attempt(
        "make a copy of a descriptor by fcntl",
        &[Limits, SystemCalls],
        |_| done(call(libc::SYS_fcntl, [0, libc::F_DUPFD as usize, 0])),
    ),
    attempt("ask a descriptor by fcntl", &[SystemCalls], |_| {
        done(call(libc::SYS_fcntl, [0, libc::F_GETFL as usize, 0]))
    }),
    attempt("control a device", &[SystemCalls], |_| {
        let mut count = [0_u32; 2];
        // of its output, which is a pipe
        done(call(
            libc::SYS_ioctl,
            [1, libc::FIONREAD as usize, address_of(&mut count)],
        ))
    }),
    attempt("make a pipe", &[Limits, SystemCalls], |_| {
        let mut ends = [0_u32; 2];
        done(call(libc::SYS_pipe2, [address_of(&mut ends), 0]))
    }),
    attempt("read a variable of the environment", &[], |_| {
        // what two allocators are given is all there is
        let names = std::env::vars_os().map(|(name, _)| name.to_string_lossy().into_owned());
        let mut others = names.filter(|name| !OF_ALLOCATORS.contains(&name.as_str()));
        others.next().ok_or_else(|| refused("there is none"))
    }),
    // --- the network
    attempt("open a socket for TCP", &[Limits, SystemCalls], |_| {
        done(socket(libc::AF_INET, libc::SOCK_STREAM))
    }),
    attempt(
        "open a socket for TCP by IPv6",
        &[Limits, SystemCalls],
        |_| done(socket(libc::AF_INET6, libc::SOCK_STREAM)),
    )
    .may_work(),
    attempt("open a socket for UDP", &[Limits, SystemCalls], |_| {
        done(socket(libc::AF_INET, libc::SOCK_DGRAM))
    }),
    attempt(
        "open a socket of this machine",
        &[Limits, SystemCalls],
        |_| done(socket(libc::AF_UNIX, libc::SOCK_STREAM)),
    ),
    attempt(
        "open a socket to the system",
        &[Limits, SystemCalls],
        |_| done(socket(libc::AF_NETLINK, libc::SOCK_RAW)),
    )
    .may_work(),
    attempt(
        "open a socket for every packet",
        &[Limits, SystemCalls],
        |_| done(socket(libc::AF_PACKET, libc::SOCK_RAW)),
    )
    .may_work(),
    attempt("make a pair of sockets", &[Limits, SystemCalls], |_| {
        let mut ends = [0_u32; 2];
        let kind = [libc::AF_UNIX as usize, libc::SOCK_STREAM as usize];
        done(call(
            libc::SYS_socketpair,
            [kind[0], kind[1], 0, address_of(&mut ends)],
        ))
    }),
    attempt(
        "connect by TCP",
        &[Network, Limits, SystemCalls],
        |errand| {
            let stream = TcpStream::connect((Ipv4Addr::LOCALHOST, errand.port))?;
            Ok(format!("{stream:?}"))
        },
    ),
    attempt("listen by TCP", &[Network, Limits, SystemCalls], |_| {
        let listener = std::net::TcpListener::bind((Ipv4Addr::LOCALHOST, 0))?;
        Ok(format!("{listener:?}"))
    }),
    attempt(
        "connect to an abstract socket",
        &[Network, Limits, SystemCalls],
        |errand| {
            let address = SocketAddr::from_abstract_name(&errand.socket)?;
            Ok(format!("{:?}", UnixStream::connect_addr(&address)?))
        },
    ),
    // --- processes and threads
    attempt("start a process by clone", &[SystemCalls], |_| clone(0)).for_users(&[Limits]),
    attempt(
        "start a process by clone, waiting for it",
        &[SystemCalls],
        |_| clone(libc::CLONE_VFORK as usize),
    )
    .for_users(&[Limits]),
    attempt("start a process by clone3", &[SystemCalls], |_| {
        let mut arguments = [0_u64; 11];
        arguments[4] = CHILD as u64;
        forked(|| call(libc::SYS_clone3, [address(&arguments), 88]))
    })
    .may_work()
    .for_users(&[Limits]),
    #[cfg(target_arch = "x86_64")]
    attempt("start a process by fork", &[SystemCalls], |_| {
        forked(|| call(libc::SYS_fork, []))
    })
    .for_users(&[Limits]),
    // the new process would return on the stack of this one
    #[cfg(target_arch = "x86_64")]
    attempt("start a process by vfork", &[SystemCalls], |_| {
        forked(|| call(libc::SYS_vfork, []))
    })
    .never_unsealed(),
    attempt("start a thread", &[SystemCalls], |_| {
        let thread = std::thread::Builder::new().spawn(|| {})?;
        thread.join().map_err(|_| refused("a panic"))?;
        Ok("a thread".to_owned())
    })
    .for_users(&[Limits]),
    attempt("become another program", &[Files, SystemCalls], |_| {
        execute("/bin/true")
    }),
    attempt(
        "become another program by execveat",
        &[Files, SystemCalls],
        |_| {
            let (file, nothing) = (path("/bin/true"), [0_usize]);
            let words = [file.as_ptr() as usize, 0];
            let arguments = [HERE, words[0], address(&words), address(&nothing), 0];
            done(call(libc::SYS_execveat, arguments))
        },
    ),
    attempt("become this program anew", &[Files, SystemCalls], |_| {
        execute("/proc/self/exe")
    })
    .never_unsealed(),
    attempt("debug the grader", &[Files, SystemCalls], |errand| {
        /// Attaches without stopping.
        const SEIZE: usize = 0x4206;
        done(call(libc::SYS_ptrace, [SEIZE, errand.grader, 0, 0]))
    })
    .may_work(),
    attempt("be debugged by the grader", &[SystemCalls], |_| {
        done(call(
            libc::SYS_ptrace,
            [libc::PTRACE_TRACEME as usize, 0, 0, 0],
        ))
    }),
    attempt(
        "read the grader's memory",
        &[Files, SystemCalls],
        |errand| {
            let mut bytes = [0_u8; 16];
            let here = [bytes.as_mut_ptr() as usize, bytes.len()];
            let there = [errand.secret, 16];
            let arguments = [errand.grader, address(&here), 1, address(&there), 1, 0];
            call(libc::SYS_process_vm_readv, arguments)?;
            Ok(String::from_utf8_lossy(&bytes).into_owned())
        },
    )
    .may_work(),
    attempt(
        "write into the grader's memory",
        &[Files, SystemCalls],
        |errand| {
            let bytes = [0_u8; 16];
            let here = [address(&bytes), bytes.len()];
            let there = [errand.secret, 16];
            let arguments = [errand.grader, address(&here), 1, address(&there), 1, 0];
            done(call(libc::SYS_process_vm_writev, arguments))
        },
    )
    .never_unsealed(),
    // --- signals
    attempt(
        "ask whether the grader is there",
        &[Network, SystemCalls],
        |errand| done(call(libc::SYS_kill, [errand.grader, 0])),
    ),
    attempt("signal the grader", &[Network, SystemCalls], |errand| {
        done(call(libc::SYS_kill, [errand.grader, UNNOTICED]))
    }),
    attempt("end the grader", &[Network, SystemCalls], |errand| {
        done(call(
            libc::SYS_kill,
            [errand.grader, libc::SIGTERM as usize],
        ))
    })
    .never_unsealed(),
    attempt(
        "signal a thread of the grader",
        &[Network, SystemCalls],
        |errand| {
            done(call(
                libc::SYS_tgkill,
                [errand.grader, errand.grader, UNNOTICED],
            ))
        },
    ),
    attempt(
        "signal a thread by its number alone",
        &[Network, SystemCalls],
        |errand| done(call(libc::SYS_tkill, [errand.grader, UNNOTICED])),
    ),
    attempt(
        "signal the grader with a value",
        &[Network, SystemCalls],
        |errand| {
            let mut about = [0_u32; 32];
            about[0] = UNNOTICED as u32;
            // as one that was queued
            about[2] = -1_i32 as u32;
            let arguments = [errand.grader, UNNOTICED, address(&about)];
            done(call(libc::SYS_rt_sigqueueinfo, arguments))
        },
    ),
    attempt(
        "hold on to the grader's process",
        &[Limits, SystemCalls],
        |errand| done(call(libc::SYS_pidfd_open, [errand.grader, 0])),
    ),
    attempt("signal everybody", &[SystemCalls], |_| {
        done(call(libc::SYS_kill, [usize::MAX, UNNOTICED]))
    })
    .never_unsealed(),
    attempt("handle the signal for its time", &[SystemCalls], |_| {
        let ignored = [1_usize, 0, 0, 0];
        let arguments = [libc::SIGXCPU as usize, address(&ignored), 0, 8];
        done(call(libc::SYS_rt_sigaction, arguments))
    }),
    // --- its session and its limits
    attempt(
        "be in the session of the grader",
        &[Session, SystemCalls],
        |errand| {
            let own = call(libc::SYS_getsid, [0])?;
            let other = call(libc::SYS_getsid, [errand.grader])?;
            match own == other {
                true => Ok(format!("session {own}")),
                false => Err(refused("it is in a session of its own")),
            }
        },
    ),
    attempt("begin a session", &[Session, SystemCalls], |_| {
        done(call(libc::SYS_setsid, []))
    }),
    attempt("outlive the grader", &[Session, SystemCalls], |_| {
        let mut signal = [0_u32; 2];
        control(libc::PR_GET_PDEATHSIG, address_of(&mut signal))?;
        match signal[0] {
            0 => Ok("no signal".to_owned()),
            _ => Err(refused("it ends with the grader")),
        }
    }),
    attempt("do without the grader's end", &[SystemCalls], |_| {
        done(control(libc::PR_SET_PDEATHSIG, 0))
    }),
    attempt(
        "be open to debuggers",
        &[Session, SystemCalls],
        |_| match control(libc::PR_GET_DUMPABLE, 0)? {
            1 => Ok("open".to_owned()),
            _ => Err(refused("it is closed")),
        },
    ),
    attempt("open itself to debuggers again", &[SystemCalls], |_| {
        done(control(libc::PR_SET_DUMPABLE, 1))
    }),
    attempt("leave a core", &[Limits, SystemCalls], |_| {
        match limit(libc::RLIMIT_CORE)? {
            [_, 0] => Err(refused("no core has a size")),
            [_, most] => Ok(format!("{most} bytes")),
        }
    })
    .may_work(),
    attempt(
        "have CPU time without end",
        &[Limits, SystemCalls],
        |_| match limit(libc::RLIMIT_CPU)? {
            [_, u64::MAX] => Ok("no limit".to_owned()),
            [_, most] => Err(refused(&format!("{most} s"))),
        },
    )
    .may_work(),
    attempt("write a larger file", &[SystemCalls], |_| raise(0)).for_users(&[Limits]),
    attempt(
        "change the limits of the grader",
        &[SystemCalls],
        |errand| {
            let mut limit = [0_u64; 2];
            let which = libc::RLIMIT_CORE as usize;
            let arguments = [errand.grader, which, 0, address_of(&mut limit)];
            done(call(libc::SYS_prlimit64, arguments))
        },
    ),
    attempt("have another priority", &[SystemCalls], |_| {
        done(call(libc::SYS_setpriority, [0, 0, 19]))
    }),
    attempt("run on other processors", &[SystemCalls], |_| {
        let all = [u64::MAX; 16];
        done(call(libc::SYS_sched_setaffinity, [0, 128, address(&all)]))
    }),
    // --- memory
    attempt("take a gigabyte", &[Limits], |_| done(map(GIGABYTE, DATA))),
    attempt("let a page grow to a gigabyte", &[Limits], |_| {
        let page = map(PAGE, DATA)?;
        let arguments = [page, PAGE, GIGABYTE, libc::MREMAP_MAYMOVE as usize];
        done(call(libc::SYS_mremap, arguments))
    }),
    attempt("move the end of its data by a gigabyte", &[Limits], |_| {
        let end = call(libc::SYS_brk, [0])?;
        // where it cannot, it says where the end is
        match call(libc::SYS_brk, [end + GIGABYTE])? {
            same if same == end => Err(refused("it stays where it is")),
            moved => Ok(moved.to_string()),
        }
    })
    .may_work(),
    attempt("keep memory from being swapped", &[SystemCalls], |_| {
        let page = map(PAGE, DATA)?;
        done(call(libc::SYS_mlock, [page, PAGE]))
    })
    .for_users(&[Limits]),
    attempt("take memory for code", &[SystemCalls], |_| {
        done(map(PAGE, CODE))
    }),
    attempt("make memory code", &[SystemCalls], |_| {
        let page = map(PAGE, DATA)?;
        done(call(libc::SYS_mprotect, [page, PAGE, CODE as usize]))
    }),
    attempt("make memory code by a key", &[SystemCalls], |_| {
        let page = map(PAGE, DATA)?;
        let arguments = [page, PAGE, CODE as usize, usize::MAX];
        done(call(libc::SYS_pkey_mprotect, arguments))
    })
    .may_work(),
    attempt("make a file of memory", &[Limits, SystemCalls], |_| {
        let name = path("x");
        done(call(libc::SYS_memfd_create, [name.as_ptr() as usize, 0]))
    }),
    attempt("share memory by a number", &[SystemCalls], |_| {
        let flags = (libc::IPC_CREAT | 0o600) as usize;
        let shared = call(libc::SYS_shmget, [libc::IPC_PRIVATE as usize, PAGE, flags])?;
        done(call(libc::SYS_shmctl, [shared, libc::IPC_RMID as usize, 0]))
    })
    .may_work(),
    // --- parts of the system that have had holes
    attempt("set up io_uring", &[Limits, SystemCalls], |_| {
        let mut settings = [0_u64; 32];
        done(call(
            libc::SYS_io_uring_setup,
            [1, address_of(&mut settings)],
        ))
    })
    .may_work(),
    attempt("load a program into the system", &[SystemCalls], |_| {
        // a list of one number
        let list = [2_u32, 4, 4, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];
        done(call(libc::SYS_bpf, [0, address(&list), 64]))
    })
    .may_work(),
    attempt("count events of the processor", &[SystemCalls], |_| {
        let mut event = [0_u32; 32];
        (event[0], event[1]) = (1, 128);
        let all = usize::MAX;
        let arguments = [address(&event), 0, all, all, 0];
        done(call(libc::SYS_perf_event_open, arguments))
    })
    .may_work(),
    attempt("handle its own page faults", &[Limits, SystemCalls], |_| {
        done(call(libc::SYS_userfaultfd, [0]))
    })
    .may_work(),
    attempt("have its own view of the system", &[SystemCalls], |_| {
        done(call(libc::SYS_unshare, [libc::CLONE_FS as usize]))
    }),
    attempt("be root in a world of its own", &[SystemCalls], |_| {
        done(call(libc::SYS_unshare, [libc::CLONE_NEWUSER as usize]))
    })
    .may_work(),
    attempt("ask for a key", &[SystemCalls], |_| {
        /// The keys of this session.
        const SESSION: usize = -3_isize as usize;
        done(call(libc::SYS_keyctl, [0, SESSION, 1]))
    })
    .may_work(),
    attempt("have another personality", &[SystemCalls], |_| {
        done(call(libc::SYS_personality, [0xffff_ffff]))
    }),
    attempt("filter system calls anew", &[SystemCalls], |_| {
        done(control(libc::PR_SET_NO_NEW_PRIVS, 1))
    })
    .never_unsealed(),
    attempt("read the system's log", &[SystemCalls], |_| {
        /// The size of its buffer.
        const SIZE: usize = 10;
        done(call(libc::SYS_syslog, [SIZE, 0, 0]))
    })
    .may_work(),
    attempt("ask for the machine's name", &[SystemCalls], |_| {
        let mut names = [0_u8; 512];
        done(call(libc::SYS_uname, [address_of(&mut names)]))
    }),
    attempt("ask who it is", &[SystemCalls], |_| {
        done(call(libc::SYS_getuid, []))
    }),
    attempt("set a timer", &[SystemCalls], |_| {
        let never = [0_u64; 4];
        done(call(libc::SYS_setitimer, [0, address(&never), 0]))
    }),
    attempt("sleep", &[SystemCalls], |_| {
        let time = [0_u64, 1];
        done(call(libc::SYS_nanosleep, [address(&time), 0]))
    }),
    #[cfg(target_arch = "x86_64")]
    attempt("open a file by a number of x32", &[SystemCalls], |errand| {
        /// What marks the numbers of that interface.
        const X32: libc::c_long = 0x4000_0000;
        on_file(errand, X32 + libc::SYS_openat, [0; 3])
    })
    .may_work(),
    #[cfg(target_arch = "x86_64")]
    attempt(
        "call the system as a program of 32 bits",
        &[SystemCalls],
        |_| crate::system_call::of_32_bits(),
    )
    .may_work(),
];
