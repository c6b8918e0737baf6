#!/bin/sh
# Starts sbt. Needs a JDK 17 or newer and nothing else: the launcher is fetched once from Maven
# Central, checked against the sum below, and kept in ${XDG_CACHE_HOME:-$HOME/.cache}/candela.
#
#   JAVA_HOME           the JDK to use, instead of the `java` on PATH
#   SBT_OPTS            further options for sbt's JVM, such as -Xmx4g
#   SBT_LAUNCHER_REPO   a Maven repository to fetch from, instead of Maven Central
set -eu

version=1.13.0 # the same as in project/build.properties
sha256=18d4a733eae2f70fd4d71a46e9da21d2eb7c9bf6ee85a67be9a9800e7c01403e
repo=${SBT_LAUNCHER_REPO:-https://repo1.maven.org/maven2}
url=${repo%/}/org/scala-sbt/sbt-launch/$version/sbt-launch-$version.jar

fail() {
  printf 'sbt: %s\n' "$@" >&2
  exit 1
}

has() { command -v "$1" >/dev/null 2>&1; }

case $0 in */*) here=${0%/*} ;; *) here=. ;; esac
cd -- "$here"
here=$(pwd -P)

# --- the JDK -----------------------------------------------------------------------------------

if [ -n "${JAVA_HOME:-}" ]; then
  java=$JAVA_HOME/bin/java
  [ -x "$java" ] || fail "JAVA_HOME is $JAVA_HOME, but there is no java in its bin folder." \
    "Point JAVA_HOME at a JDK 17 or newer, or unset it to use the java on PATH."
elif has java; then
  java=$(command -v java)
else
  fail "no java found: JAVA_HOME is not set, and there is no java on PATH." \
    "Install a JDK 17 or newer, for example from https://adoptium.net"
fi

found=$("$java" -version 2>&1) || fail "$java does not run:" "$found"
full=$(printf '%s\n' "$found" | sed -n 's/.* version "\([^"]*\)".*/\1/p')
major=${full%%[!0-9]*}
[ "${major:-0}" -ge 17 ] || fail "a JDK 17 or newer is needed, but $java is version ${full:-unknown}:" \
  "$found" "Set JAVA_HOME to a newer one."

# --- the launcher ------------------------------------------------------------------------------

# Without a home that can be written to, everything is kept inside the checkout.
home=${HOME:-}
if [ ! -d "$home" ] || [ ! -w "$home" ]; then home=$here/project/target/home; fi
cache=${XDG_CACHE_HOME:-$home/.cache}/candela
launcher=$cache/sbt-launch-$version.jar

with_java() { # SBT_OPTS may hold proxy settings; each option is a word of its own
  "$java" ${SBT_OPTS:-} project/fetch/Fetch.java "$@"
}

sum_of() {
  if has sha256sum; then
    sum=$(sha256sum <"$1")
  elif has shasum; then
    sum=$(shasum -a 256 <"$1")
  else
    sum=$(with_java sha256 "$1")
  fi
  printf '%s\n' "${sum%% *}"
}

# Each way is tried until one works: a curl that lacks certificates must not stop a good wget.
fetch_to() {
  if has curl && curl --fail --silent --show-error --location --retry 2 --connect-timeout 20 \
    --output "$1" "$url"; then return 0; fi
  if has wget && wget -q -O "$1" "$url"; then return 0; fi
  with_java get "$url" "$1"
}

mkdir -p "$cache" || fail "cannot create the folder $cache"
work=$(mktemp -d "$cache/work.XXXXXX") || fail "cannot write in $cache"
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP

if [ -f "$launcher" ] && [ "$(sum_of "$launcher")" != "$sha256" ]; then
  printf 'sbt: %s is damaged; fetching it again\n' "$launcher" >&2
  rm -f "$launcher"
fi
if [ ! -f "$launcher" ]; then
  printf 'sbt: fetching the sbt %s launcher from %s\n' "$version" "$repo" >&2
  fetch_to "$work/launcher.jar" || fail "could not fetch $url"
  sum=$(sum_of "$work/launcher.jar")
  [ "$sum" = "$sha256" ] || fail "the file from $url is not the expected one; it was removed." \
    "expected SHA-256 $sha256" "found    SHA-256 $sum"
  mv -f "$work/launcher.jar" "$launcher" # one step, so two first starts at once do no harm
fi
rm -rf "$work"
trap - EXIT INT TERM HUP

# --- sbt ---------------------------------------------------------------------------------------

set -- -jar "$launcher" "$@"
# Java takes the home from the user database; sbt's caches shall follow HOME, like the launcher.
set -- -Duser.home="$home" -Dfile.encoding=UTF-8 ${SBT_OPTS:-} "$@"
# JDK 24 and later warn about what Scala's lazy values do.
if [ "$major" -ge 23 ]; then set -- --sun-misc-unsafe-memory-access=allow "$@"; fi
exec "$java" -Xms256m -Xmx2g -Xss8m -XX:+UseParallelGC -XX:ReservedCodeCacheSize=256m \
  --enable-native-access=ALL-UNNAMED "$@"
