# What the playground is built and tested with, where it is missing.
set -e
need=
command -v clang >/dev/null || need="$need clang"
command -v wasm-ld >/dev/null || need="$need lld"
test -d /usr/include/wasm32-wasi || need="$need wasi-libc"
ls /usr/lib/llvm-*/lib/clang/*/lib/wasi/libclang_rt.builtins-wasm32.a >/dev/null 2>&1 || need="$need libclang-rt-dev-wasm32"
command -v chromium >/dev/null || need="$need chromium"
command -v node >/dev/null || need="$need nodejs"
command -v npm >/dev/null || need="$need npm"
if [ -n "$need" ]; then
    apt-get update -qq
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $need
fi
mkdir -p "$1"
if [ ! -d "$1/node_modules/playwright-core" ]; then
    npm install --prefix "$1" --no-audit --no-fund --no-save --loglevel=error playwright-core
fi
