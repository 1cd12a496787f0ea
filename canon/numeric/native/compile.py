"""Text of LLVM to machine code of this processor, kept while the program that calls it lives."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final

from canon.numeric.native.loop import ENTRY, PREPARE

_INTEGERS: Final = (ctypes.c_int64,)
_RUN: Final = ctypes.CFUNCTYPE(
    ctypes.c_int64, *(ctypes.c_void_p,) * 4, *_INTEGERS * 4, *(ctypes.c_double,) * 2, *_INTEGERS * 3
)
_PREPARE: Final = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_double)


@dataclass(frozen=True)
class Processor:
    """What there is: doubles in a register, registers, and whether a·b + c is one instruction."""

    width: int
    registers: int
    fused: bool


@dataclass(frozen=True)
class Code:
    """The functions of a module; `owner` keeps their memory."""

    run: Any
    prepare: Any
    owner: Any


@lru_cache(maxsize=1)
def processor() -> Processor:
    """This machine's processor."""
    features = _binding().get_host_cpu_features()
    name = _binding().get_process_triple().split("-")[0]
    if features.get("avx512f"):
        return Processor(8, 32, True)
    if features.get("avx"):
        return Processor(4, 16, bool(features.get("fma")))
    if name in ("aarch64", "arm64"):
        return Processor(2, 32, True)
    return Processor(2, 16, bool(features.get("fma")))


def tried() -> None:
    """Compile next to nothing. **Raises:** whatever a library does that is missing, broken, or of another version."""
    llvm = _binding()
    machine = _machine()
    module = llvm.parse_assembly("define i64 @nothing() { ret i64 0 }")
    optimised(module, machine)
    llvm.create_mcjit_compiler(module, machine).finalize_object()


def compiled(text: str) -> Code:
    """The functions of a module."""
    llvm = _binding()
    machine = _machine()
    module = llvm.parse_assembly(text)
    optimised(module, machine)
    engine = llvm.create_mcjit_compiler(module, machine)
    engine.finalize_object()
    return Code(_RUN(engine.get_function_address(ENTRY)), _PREPARE(engine.get_function_address(PREPARE)), engine)


def optimised(module: Any, machine: Any) -> None:
    llvm = _binding()
    passes = llvm.create_new_module_pass_manager()
    for add in (passes.add_sroa_pass, passes.add_simplify_cfg_pass):
        add()
    options = llvm.create_pipeline_tuning_options(speed_level=2)
    passes.run(module, llvm.create_pass_builder(machine, options))


@lru_cache(maxsize=1)
def _binding() -> Any:
    import llvmlite.binding as llvm

    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    return llvm


def _machine() -> Any:
    llvm = _binding()
    target = llvm.Target.from_triple(llvm.get_process_triple())
    features = llvm.get_host_cpu_features().flatten()
    return target.create_target_machine(cpu=llvm.get_host_cpu_name(), features=features, opt=2, jit=True)
