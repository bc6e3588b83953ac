//! What a worker gives up before it reads the first byte of a submission: files, network, other processes, system calls that it does not
//! need, and memory and time without bound. Each layer stands by itself, so that a hole in one is not a hole.
//!
//! It uses nothing of the rest of this crate: a test seals a process of its own with it, which then tries to get out.

use std::fmt;
use std::io;
use std::sync::mpsc::channel;

/// One thing that a worker gives up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Layer {
    /// Memory, CPU time, sizes of files, open files and processes, by limits of the system.
    Limits,
    /// Descriptors that it inherited besides its pipes.
    Descriptors,
    /// The terminal and the process group of the grader; it ends with the grader, and nobody can look into it.
    Session,
    /// Every file and folder, by Landlock.
    Files,
    /// TCP, and since Linux 6.12 signals and abstract sockets, by Landlock.
    Network,
    /// Every system call but those that computing takes, by seccomp.
    SystemCalls,
}

impl Layer {
    /// All, in the order in which they are put on.
    pub(crate) const ALL: [Self; 6] = [
        Self::Limits,
        Self::Descriptors,
        Self::Session,
        Self::Files,
        Self::Network,
        Self::SystemCalls,
    ];

    /// What it is, for people.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Limits => "limits on memory, CPU time, files and processes",
            Self::Descriptors => "inherited descriptors closed",
            Self::Session => "a session of its own, closed to debuggers",
            Self::Files => "no file system (Landlock)",
            Self::Network => "no network (Landlock)",
            Self::SystemCalls => "only system calls that computing takes (seccomp)",
        }
    }

    fn bit(self) -> u8 {
        1 << (self as u8)
    }
}

/// Which layers are on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Sealed(u8);

impl Sealed {
    /// The layers of these bits; unknown bits are dropped.
    pub(crate) fn from_bits(bits: u8) -> Self {
        let known = Layer::ALL.iter().fold(0, |bits, layer| bits | layer.bit());
        Self(bits & known)
    }

    /// As one byte.
    pub(crate) fn bits(self) -> u8 {
        self.0
    }

    /// Whether `layer` is on.
    pub(crate) fn has(self, layer: Layer) -> bool {
        self.0 & layer.bit() != 0
    }

    /// The layers that are not on.
    pub(crate) fn missing(self) -> impl Iterator<Item = Layer> {
        Layer::ALL
            .into_iter()
            .filter(move |layer| !self.has(*layer))
    }

    #[cfg(unix)]
    fn note(&mut self, layer: Layer, is_on: bool) {
        if is_on {
            self.0 |= layer.bit();
        }
    }
}

impl fmt::Display for Sealed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<&str> = Layer::ALL
            .into_iter()
            .filter(|layer| self.has(*layer))
            .map(Layer::name)
            .collect();
        f.write_str(&names.join(", "))
    }
}

/// CPU seconds of one worker: far above what the counted budgets allow.
#[cfg(unix)]
const CPU_SECONDS: u64 = 50;
/// Between the signal that says so, and the one that cannot be refused.
#[cfg(unix)]
const CPU_GRACE_SECONDS: u64 = 5;
/// Address space of a worker.
#[cfg(unix)]
const ADDRESS_SPACE_BYTES: u64 = 512 << 20;

/// What the first thread does while the other one works.
#[derive(Debug)]
pub(crate) struct Beside<'a> {
    /// The processors on which it does it; where there are none, it does nothing.
    pub(crate) processors: &'a [usize],
    /// What it does, with nothing of the submission.
    pub(crate) work: fn(),
}

/// Seals this process, and does `work` in a thread of its own, which begins once every layer is on. Call it in the first thread, with no
/// other beside it; `parent` is the process that this one must not outlive. `None` if that is gone: there is nothing to seal for.
///
/// # Errors
/// If no thread starts, or `work` panics.
pub(crate) fn in_sealed_thread<T: Send + 'static>(
    parent: Option<i32>,
    stack_bytes: usize,
    beside: Beside<'_>,
    work: impl FnOnce(Sealed) -> T + Send + 'static,
) -> io::Result<Option<T>> {
    let Some(mut sealed) = seal(parent) else {
        return Ok(None);
    };
    let (started, has_started) = channel();
    let (ready, begin) = channel();
    let thread = std::thread::Builder::new()
        .stack_size(stack_bytes)
        .spawn(move || {
            // a thread begins with system calls that it may not make later
            let _ = started.send(());
            // nothing is read before every layer is on
            begin.recv().map(work)
        })?;
    let _ = has_started.recv();
    let has_processors = move_to(beside.processors);
    seal_threads(&mut sealed);
    ready.send(sealed).map_err(io::Error::other)?;
    if has_processors {
        (beside.work)();
    }
    let ended = thread.join().map_err(|_| io::Error::other("a panic"))?;
    ended.map(Some).map_err(io::Error::other)
}

/// Moves the first thread away from the processor that the other one shares with the grader; false if there is nowhere to go.
#[cfg(target_os = "linux")]
fn move_to(processors: &[usize]) -> bool {
    use rustix::thread::{CpuSet, sched_setaffinity};
    let mut set = CpuSet::new();
    for processor in processors.iter().filter(|cpu| **cpu < CpuSet::MAX_CPU) {
        set.set(*processor);
    }
    set.count() > 0 && sched_setaffinity(None, &set).is_ok()
}

/// This system has no such choice.
#[cfg(not(target_os = "linux"))]
fn move_to(_processors: &[usize]) -> bool {
    false
}

/// Puts on every layer that does not depend on the threads of the process.
#[cfg(unix)]
#[cfg_attr(
    not(target_os = "linux"),
    expect(unused_variables, reason = "only Linux says that a parent is gone")
)]
fn seal(parent: Option<i32>) -> Option<Sealed> {
    let mut sealed = Sealed::default();
    sealed.note(Layer::Descriptors, close_inherited());
    #[cfg(target_os = "linux")]
    {
        sealed.note(Layer::Session, linux::leave_session(parent)?);
        let (files, network) = linux::landlock();
        sealed.note(Layer::Files, files);
        sealed.note(Layer::Network, network);
    }
    sealed.note(Layer::Limits, limits());
    Some(sealed)
}

/// This system has no layers: budgets and a process of its own are all there is.
#[cfg(not(unix))]
fn seal(_parent: Option<i32>) -> Option<Sealed> {
    Some(Sealed::default())
}

/// Puts on the layers of all threads, when all of them have started: from here on no thread and no process can.
#[cfg(target_os = "linux")]
fn seal_threads(sealed: &mut Sealed) {
    let is_on = linux::no_more_processes();
    if !is_on {
        sealed.0 &= !Layer::Limits.bit();
    }
    sealed.note(Layer::SystemCalls, linux::filter_system_calls());
}

/// This system has none.
#[cfg(not(target_os = "linux"))]
fn seal_threads(_sealed: &mut Sealed) {}

/// Closes every descriptor but the three that every program has.
#[cfg(unix)]
#[expect(
    unsafe_code,
    reason = "whatever owned these descriptors ran in another program, before this one began"
)]
pub(crate) fn close_inherited() -> bool {
    // SAFETY: nothing in this process has opened a file yet, so that no owner of a descriptor is left with a closed one
    unsafe { close_fds::close_open_fds(3, &[]) };
    true
}

/// Limits of the system, soft and hard; none can be raised again.
#[cfg(unix)]
pub(crate) fn limits() -> bool {
    use rustix::process::{Resource, Rlimit, setrlimit};
    let limits = [
        (Resource::As, ADDRESS_SPACE_BYTES, ADDRESS_SPACE_BYTES),
        // the kernel sends the signal for the soft limit first, so that its end is not taken for one by lack of memory
        (Resource::Cpu, CPU_SECONDS, CPU_SECONDS + CPU_GRACE_SECONDS),
        (Resource::Core, 0, 0),
        (Resource::Fsize, 0, 0),
        (Resource::Nofile, 0, 0),
        (Resource::Memlock, 0, 0),
    ];
    let mut all = true;
    for (resource, soft, hard) in limits {
        let limit = Rlimit {
            current: Some(soft),
            maximum: Some(hard),
        };
        all &= setrlimit(resource, limit).is_ok();
    }
    all
}

/// The layers that only Linux has.
#[cfg(target_os = "linux")]
pub(crate) mod linux {
    use std::collections::BTreeMap;

    use landlock::{
        ABI, Access as _, AccessFs, AccessNet, CompatLevel, Compatible as _, Ruleset,
        RulesetAttr as _, RulesetStatus, Scope,
    };
    use rustix::process::{DumpableBehavior, Pid, Resource, Rlimit, Signal, getppid, setrlimit};
    use seccompiler::{
        BpfProgram, SeccompAction, SeccompCmpArgLen, SeccompCmpOp, SeccompCondition, SeccompFilter,
        SeccompRule, TargetArch,
    };

    /// Leaves the terminal and the group of the grader, ends with it, and closes itself to other processes of the same user. `None`
    /// if the grader went away before this process could ask to go with it.
    pub(crate) fn leave_session(parent: Option<i32>) -> Option<bool> {
        // it leads no group yet, so that this cannot fail; a terminal's signals go to the grader alone
        let own = rustix::process::setsid().is_ok();
        let root = std::env::set_current_dir("/").is_ok();
        let dies = rustix::process::set_parent_process_death_signal(Some(Signal::KILL)).is_ok();
        let closed = rustix::process::set_dumpable_behavior(DumpableBehavior::NotDumpable).is_ok();
        let now = getppid().map(Pid::as_raw_nonzero).map(i32::from);
        if parent.is_some() && now != parent {
            return None;
        }
        Some(own && root && dies && closed)
    }

    /// Whether no file is left, and no network.
    pub(crate) fn landlock() -> (bool, bool) {
        let files = AccessFs::from_all(ABI::V5);
        let restrict = |network: bool| {
            let rules = Ruleset::default().set_compatibility(CompatLevel::BestEffort);
            let mut rules = rules.handle_access(files)?;
            if network {
                rules = rules
                    .handle_access(AccessNet::from_all(ABI::V5))?
                    .scope(Scope::from_all(ABI::V6))?;
            }
            rules.create()?.restrict_self()
        };
        let Ok(status) = restrict(true) else {
            return (false, false);
        };
        match status.ruleset {
            RulesetStatus::FullyEnforced => (true, true),
            // an older kernel: what it knows of files is closed, and what it does not know, seccomp closes
            RulesetStatus::PartiallyEnforced => (true, false),
            RulesetStatus::NotEnforced => (false, false),
        }
    }

    /// No process and no thread can be started; as root the system does not count, and the filter of system calls stands alone.
    pub(crate) fn no_more_processes() -> bool {
        let none = Rlimit {
            current: Some(0),
            maximum: Some(0),
        };
        setrlimit(Resource::Nproc, none).is_ok()
    }

    /// Lets through what computing, answering and ending take. Everything else fails with "operation not permitted".
    pub(crate) fn filter_system_calls() -> bool {
        program().is_some_and(|program| seccompiler::apply_filter_all_threads(&program).is_ok())
    }

    fn program() -> Option<BpfProgram> {
        let arch = TargetArch::try_from(std::env::consts::ARCH).ok()?;
        let filter = SeccompFilter::new(
            rules()?,
            SeccompAction::Errno(libc::EPERM.cast_unsigned()),
            SeccompAction::Allow,
            arch,
        );
        filter.ok()?.try_into().ok()
    }

    fn rules() -> Option<BTreeMap<i64, Vec<SeccompRule>>> {
        // reading requests, writing answers, memory, waiting for the other thread, the end
        let free = [
            libc::SYS_read,
            libc::SYS_write,
            libc::SYS_writev,
            libc::SYS_brk,
            libc::SYS_munmap,
            libc::SYS_mremap,
            libc::SYS_madvise,
            libc::SYS_futex,
            libc::SYS_sched_yield,
            libc::SYS_clock_gettime,
            libc::SYS_getrandom,
            libc::SYS_gettid,
            libc::SYS_getpid,
            libc::SYS_rt_sigreturn,
            libc::SYS_rt_sigprocmask,
            libc::SYS_sigaltstack,
            libc::SYS_set_robust_list,
            libc::SYS_exit,
            libc::SYS_exit_group,
        ];
        let mut rules: BTreeMap<i64, Vec<SeccompRule>> =
            free.into_iter().map(|call| (call, Vec::new())).collect();
        let only = |argument, operation, value| {
            let condition =
                SeccompCondition::new(argument, SeccompCmpArgLen::Dword, operation, value);
            SeccompRule::new(vec![condition.ok()?]).ok()
        };
        // memory that can be run as code
        let executable = libc::PROT_EXEC.cast_unsigned().into();
        let data = only(2, SeccompCmpOp::MaskedEq(executable), 0)?;
        rules.insert(libc::SYS_mmap, vec![data.clone()]);
        rules.insert(libc::SYS_mprotect, vec![data]);
        // the runtime's handler of a memory fault takes itself away, so that the fault ends the process: else it comes again without end
        let fault = |signal: i32| only(0, SeccompCmpOp::Eq, signal.cast_unsigned().into());
        let faults = vec![fault(libc::SIGSEGV)?, fault(libc::SIGBUS)?];
        rules.insert(libc::SYS_rt_sigaction, faults);
        // an abort is a signal to itself, and to nobody else
        let own = std::process::id().into();
        rules.insert(libc::SYS_tgkill, vec![only(0, SeccompCmpOp::Eq, own)?]);
        Some(rules)
    }
}
